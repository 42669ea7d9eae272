// SPDX-License-Identifier: Apache-2.0
#include "commands/accuracy_early.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/render_job.h"
#include "commands/accuracy_reference.h"
#include "gpu/egl_context.h"
#include "reference/measures/emitter_pixels.h"
#include "reference/measures/image_metrics.h"
#include "reference/measures/structural_similarity.h"
#include "research/accuracy/scene_fingerprint.h"
#include "research/plot/line_plot.h"
#include "stream/image_encoder.h"
#include "transport/solver.h"
#include "view/image/tone_curve.h"
#include "view/viewer_image.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// What a viewer sees first, and over the next seconds (10 to 100 iterations a second).
constexpr std::uint64_t looks[] = {1, 8, 16, 32, 64, 128, 256};
constexpr std::uint64_t before_turn = 256;  // iterations
constexpr float turn = 1.0F;                // radians

/// A viewer's picture as it was after so many iterations.
struct Look {
    std::uint64_t iterations = 0;  ///< since the view began
    std::vector<glm::dvec3> radiance;
    ErrorInterval stated;
    bool known = false;
};

Look look_at(ViewerImage& image, std::uint64_t iterations) {
    Look look{iterations, {}, {}, false};
    for (const glm::vec4& pixel : image.read_radiance()) {
        look.radiance.emplace_back(pixel);
    }
    image.request_statistics();
    image.finish_statistics();
    const ImageStatistics& s = image.statistics();
    // Both this picture and the reference show the centres of pixels: what these do not resolve is
    // no error here.
    look.stated = error_interval(s.noise, 0.0, s.samples, image.sample_order());
    look.known = s.known;
    return look;
}

/// The same place, looking aside.
Camera turned(const Camera& camera) {
    const glm::vec3 ahead = camera.target - camera.eye;
    const glm::vec3 up = glm::normalize(camera.up);
    const glm::vec3 along = glm::dot(ahead, up) * up;
    Camera result = camera;
    result.target = camera.eye + along + std::cos(turn) * (ahead - along) +
                    std::sin(turn) * glm::cross(up, ahead);
    return result;
}

/// One row of the table: root mean square and mean over seeds.
struct Row {
    std::uint64_t iterations = 0;
    double error = 0.0, similarity = 0.0;
    double stated = 0.0, low = 0.0, high = 0.0;  ///< of the first seed
    unsigned known = 0, covered = 0, runs = 0;
};

class EarlyPictures {
  public:
    EarlyPictures(const Options& options, const LoadedScene& loaded)
        : options_(options),
          size_(parse_size(options.accuracy.size)),
          loaded_(loaded),
          camera_(choose_camera(loaded_.scene, options)),
          rays_(loaded_.scene, loaded_.mesh),
          view_(rays_, camera_, size_),
          measured_(measured_pixels(rays_, view_)) {}

    void run() {
        if (std::find(measured_.begin(), measured_.end(), true) == measured_.end()) {
            throw std::runtime_error("every pixel sees a lamp or the sky: nothing to measure");
        }
        for (std::uint64_t seed = options_.scene.seed;
             seed < options_.scene.seed + options_.accuracy.repeats; ++seed) {
            since_nothing_.push_back(run_once(seed, false));
            since_turn_.push_back(run_once(seed, true));
        }
        make_reference();
        Json report = {{"scene", loaded_.scene.name},
                       {"size", {size_.x, size_.y}},
                       {"seeds", options_.accuracy.repeats},
                       {"referenceNoise", noise()}};
        LinePlot plot = empty_plot();
        write("since nothing", "nothing", since_nothing_, report["sinceNothing"], plot);
        write("since a turn", "turn", since_turn_, report["sinceTurn"], plot);
        write_file((folder() / "reference.png").string(), png(reference_.radiance));
        write_file((folder() / "early.json").string(), report.dump(2) + "\n");
        write_file((folder() / "early.svg").string(), svg_of(plot));
    }

  private:
    [[nodiscard]] fs::path folder() const { return options_.output.file; }

    /// A viewer that looks from the first iteration on, or turns to the view after a while.
    [[nodiscard]] std::vector<Look> run_once(std::uint64_t seed, bool turns) const {
        SolverSettings settings;
        settings.seed = seed;
        Solver solver(loaded_.scene, loaded_.mesh, settings);
        const ViewPrograms programs(solver.scene());
        ViewerImage image(solver.scene(), solver.store(), programs, size_);
        BundleReceiver* const receivers[] = {&image};
        std::vector<Look> result;
        if (turns) {
            image.set_camera(turned(camera_));
            for (std::uint64_t i = 0; i < before_turn; ++i) {
                solver.step(receivers);
            }
            // As a viewer's picture, it knows its error when it begins to turn.
            image.request_statistics();
            image.finish_statistics();
        }
        image.set_camera(camera_);
        if (turns) {
            result.push_back(look_at(image, 0));
        }
        std::uint64_t done = 0;
        for (const std::uint64_t wanted : looks) {
            for (; done < wanted; ++done) {
                solver.step(receivers);
            }
            result.push_back(look_at(image, done));
        }
        return result;
    }

    void make_reference() {
        const ReferenceKey key{scene_fingerprint(options_.scene.file, RAYBUNDLE_VERSION), camera_,
                               size_, PixelFilter::centre};
        const LightSampling lights(rays_);
        Progress progress;
        reference_ = raybundle::make_reference(
            {rays_, lights, view_, measured_, key, (folder() / "reference_centre.exr").string(),
             mixed_bits(options_.scene.seed ^ 0x7265666572656e63ULL),
             options_.accuracy.reference_seconds.value_or(120.0),
             [this](const ReferencePicture& r) { return best_error(r); }},
            progress);
        factor_ = automatic_display_factor(reference_.radiance, measured_);
        shown_reference_ = tone_mapped(reference_.radiance, factor_);
    }

    [[nodiscard]] double noise() const {
        return reference_.noise ? reference_.noise->relative_rmse : 0.0;
    }

    [[nodiscard]] double error_of(const Look& look, const ReferencePicture& reference) const {
        const double found =
            compare_images(look.radiance, reference.radiance, measured_).relative_rmse;
        const double own = reference.noise ? reference.noise->relative_rmse : 0.0;
        return std::sqrt(std::max(found * found - own * own, 0.0));
    }

    [[nodiscard]] double best_error(const ReferencePicture& reference) const {
        double best = 1e30;
        for (const auto* runs : {&since_nothing_, &since_turn_}) {
            for (const std::vector<Look>& run : *runs) {
                for (const Look& look : run) {
                    best = std::min(best, error_of(look, reference));
                }
            }
        }
        return best;
    }

    [[nodiscard]] std::string png(const std::vector<glm::dvec3>& radiance) const {
        const std::vector<std::uint8_t> rgba = tone_mapped(radiance, factor_);
        const auto bytes =
            encode_png({rgba, static_cast<int>(size_.x), static_cast<int>(size_.y), false});
        return {bytes.begin(), bytes.end()};
    }

    [[nodiscard]] Row row_of(const std::vector<std::vector<Look>>& runs, std::size_t index) const {
        Row row;
        double square = 0.0;
        for (const std::vector<Look>& run : runs) {
            const Look& look = run[index];
            const double error = error_of(look, reference_);
            square += error * error;
            row.similarity += structural_similarity(tone_mapped(look.radiance, factor_),
                                                    shown_reference_, measured_, size_);
            row.known += look.known ? 1 : 0;
            row.covered +=
                look.known && error >= look.stated.low && error <= look.stated.high ? 1 : 0;
            ++row.runs;
        }
        const Look& first = runs.front()[index];
        row.iterations = first.iterations;
        row.error = std::sqrt(square / row.runs);
        row.similarity /= row.runs;
        row.stated = first.stated.error;
        row.low = first.stated.low;
        row.high = first.stated.high;
        return row;
    }

    static LinePlot empty_plot() {
        LinePlot plot;
        plot.title = "Error of a viewer's first pictures";
        plot.description = "relRMSE against iterations, since nothing and since a turn.";
        plot.x = {.title = "iterations", .unit = "", .scale = AxisScale::logarithmic};
        plot.y = {.title = "relRMSE", .unit = "", .scale = AxisScale::logarithmic};
        return plot;
    }

    void write(const std::string& title, const std::string& name,
               const std::vector<std::vector<Look>>& runs, Json& report, LinePlot& plot) const {
        PlotSeries series;
        series.name = title;
        series.style = plot.series.size();
        fmt::print("{:<14} iterations  relRMSE    SSIM   stated (95 % interval)    covered\n",
                   title);
        for (std::size_t i = 0; i < runs.front().size(); ++i) {
            const Row row = row_of(runs, i);
            fmt::print("{:<14} {:>10} {:>6.2f} % {:>7.4f}   {}\n", "", row.iterations,
                       100.0 * row.error, row.similarity,
                       row.known == 0 ? std::string("-")
                                      : fmt::format("{:5.1f} % ({:.1f} to {:.1f} %)   {}/{}",
                                                    100.0 * row.stated, 100.0 * row.low,
                                                    100.0 * row.high, row.covered, row.known));
            report.push_back({{"iterations", row.iterations},
                              {"relRMSE", row.error},
                              {"ssim", row.similarity},
                              {"stated", row.stated},
                              {"statedLow", row.low},
                              {"statedHigh", row.high},
                              {"known", row.known},
                              {"covered", row.covered}});
            if (row.iterations > 0) {
                series.points.push_back(
                    {.x = static_cast<double>(row.iterations), .y = row.error, .band = {}});
            }
            write_file((folder() / fmt::format("{}_{:04}.png", name, row.iterations)).string(),
                       png(runs.front()[i].radiance));
        }
        plot.series.push_back(std::move(series));
    }

    const Options& options_;
    glm::uvec2 size_;
    const LoadedScene& loaded_;
    Camera camera_;
    RayScene rays_;
    CameraRays view_;
    std::vector<bool> measured_;
    std::vector<std::vector<Look>> since_nothing_, since_turn_;
    ReferencePicture reference_;
    double factor_ = 1.0;
    std::vector<std::uint8_t> shown_reference_;
};

}  // namespace

int run_accuracy_early(const Options& options) {
    const EglContext context = create_egl_context({options.device.gpu, false});
    std::error_code error;
    fs::create_directories(options.output.file, error);
    if (error || !fs::is_directory(options.output.file)) {
        throw std::runtime_error(options.output.file + ": this folder cannot be made");
    }
    const LoadedScene loaded = load_scene(options);
    EarlyPictures(options, loaded).run();
    return exit_done;
}

}  // namespace raybundle
