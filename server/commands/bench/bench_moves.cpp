// SPDX-License-Identifier: Apache-2.0
#include "commands/bench/bench_moves.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "app/render_job.h"
#include "reference/measures/image_metrics.h"
#include "research/plot/line_plot.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle {

namespace {

using Json = nlohmann::ordered_json;

constexpr glm::uvec2 picture_size(256, 256);
constexpr double move_m = 0.6;
const std::vector<double> sample_times = {0.05, 0.1, 0.15, 0.2, 0.3, 0.5, 0.75, 1,  1.5, 2,
                                          3,    4,   6,    8,   10,  15,  20,   30, 60};

/// How much is measured. Fast devices do more iterations than these: as many as fit into a third
/// of the time after the move, and into three times as much.
struct Effort {
    std::uint64_t iterations_before = 384;      ///< of the solution that is corrected, at least
    std::uint64_t iterations_reference = 1152;  ///< of the fresh solve, at least
    double seconds = 3.0;                       ///< after the move
    bool unscissored = false;
};

Effort effort_for(std::optional<double> seconds) {
    return seconds ? Effort{768, 3072, *seconds, true} : Effort{};
}

using Picture = std::vector<glm::dvec3>;

/// What is measured after the move.
struct Variant {
    std::string name;
    unsigned bundles = 0;  ///< 0: no special phase
    bool scissored = true;
    bool restart = false;
    std::size_t style = 0;
};

std::vector<Variant> variants(const Effort& effort) {
    std::vector<Variant> all;
    std::size_t style = 0;
    for (const unsigned bundles : {1U, 3U, 10U, 30U}) {
        const std::string name = "K = " + std::to_string(bundles);
        all.push_back({name, bundles, true, false, style});
        if (effort.unscissored) {
            all.push_back({name + ", whole bundles", bundles, false, false, style});
        }
        ++style;
    }
    all.push_back({"no special phase", 0, true, false, 4});
    all.push_back({"restart", 0, true, true, 5});
    return all;
}

/// A solver with a picture of it.
class Run {
  public:
    Run(const Scene& scene, const PatchMesh& mesh, const SolverSettings& settings)
        : solver_(scene, mesh, settings),
          programs_(solver_.scene()),
          image_(solver_.scene(), solver_.store(), programs_, picture_size) {
        image_.set_camera(scene.cameras.front());
    }

    /// So many iterations, and for so long.
    void iterate(std::uint64_t count, double seconds = 0.0) {
        const std::uint64_t end = solver_.iterations() + count;
        const Stopwatch stopwatch;
        while (solver_.iterations() < end || stopwatch.seconds() < seconds) {
            step();
        }
    }
    void step() {
        solver_.step(receivers_);
        glFinish();
    }
    void move(std::uint32_t object, const glm::mat4& place) {
        solver_.move_object(object, place, receivers_);
    }
    /// Builds the programs of special phases: a move to where the object is.
    void warm_up(std::uint32_t object, const Scene& scene) {
        iterate(1);
        move(object, scene.objects[object].world_from_object());
        while (solver_.correcting()) {
            step();
        }
        iterate(GROUP_SIZE);  // judges what was kept, and serves both means
    }
    [[nodiscard]] Picture picture() {
        Picture result;
        for (const glm::vec4& p : image_.read_radiance()) {
            result.emplace_back(p);
        }
        return result;
    }
    [[nodiscard]] const Solver& solver() const { return solver_; }

  private:
    Solver solver_;
    ViewPrograms programs_;
    ViewerImage image_;
    BundleReceiver* const receivers_[1] = {&image_};
};

class MoveBench {
  public:
    MoveBench(const LoadedScene& loaded, std::uint32_t object, std::uint64_t seed,
              const Effort& effort)
        : loaded_(loaded), object_(object), seed_(seed), effort_(effort), moved_(loaded.scene) {
        moved_.objects[object].transform.translation.x += static_cast<float>(move_m);
        Run fresh(moved_, loaded_.mesh, settings(seed_ + 1000));
        fresh.iterate(effort_.iterations_reference, 3.0 * effort_.seconds);
        reference_iterations_ = fresh.solver().iterations();
        reference_ = fresh.picture();
        choose_pixels();
    }

    [[nodiscard]] std::uint64_t reference_iterations() const { return reference_iterations_; }

    Json measure(const Variant& variant) const {
        SolverSettings s = settings(seed_);
        s.special.bundles = s.special.most_bundles = std::max(variant.bundles, 1U);
        s.special.scissored = variant.scissored;
        s.special.bounces = 0;
        s.special.skipped = variant.bundles == 0;
        const Scene& first = variant.restart ? moved_ : loaded_.scene;
        Run run(first, loaded_.mesh, s);
        if (!variant.restart) {
            run.warm_up(object_, first);
            run.iterate(effort_.iterations_before, effort_.seconds / 3.0);
        }
        const double stale = error_of(run);
        double clock = 0.0;
        {
            const Stopwatch stopwatch;
            if (!variant.restart) {
                run.move(object_, moved_.objects[object_].world_from_object());
            }
            glFinish();
            clock = stopwatch.seconds();
        }
        Json points = Json::array();
        for (std::size_t next = 0; clock < effort_.seconds && next < sample_times.size();) {
            const Stopwatch stopwatch;
            run.step();
            clock += stopwatch.seconds();
            if (clock < sample_times[next] || run.solver().correcting()) {
                continue;
            }
            points.push_back({{"seconds", clock},
                              {"relRMSE", error_of(run)},
                              {"settled", run.solver().statistics().settled}});
            while (next < sample_times.size() && sample_times[next] <= clock) {
                ++next;
            }
        }
        return {{"name", variant.name},
                {"bundles", variant.bundles},
                {"scissored", variant.scissored},
                {"staleRelRMSE", stale},
                {"points", std::move(points)}};
    }

  private:
    [[nodiscard]] SolverSettings settings(std::uint64_t seed) const {
        SolverSettings s;
        s.seed = seed;
        return s;
    }

    /// Emitters are left out by their brightness.
    void choose_pixels() {
        double mean = 0.0;
        for (const glm::dvec3& r : reference_) {
            mean += r.g / static_cast<double>(reference_.size());
        }
        std::vector<bool> bright;
        for (const glm::dvec3& r : reference_) {
            bright.push_back(r.g > 20.0 * mean);
        }
        measured_ = without_emitters(bright, picture_size);
    }

    [[nodiscard]] double error_of(Run& run) const {
        return compare_images(run.picture(), reference_, measured_).relative_rmse;
    }

    const LoadedScene& loaded_;
    std::uint32_t object_;
    std::uint64_t seed_;
    Effort effort_;
    Scene moved_;
    Picture reference_;
    std::uint64_t reference_iterations_ = 0;
    std::vector<bool> measured_;
};

/// Which variant has the least error at each time.
void print_winners(const Json& curves, double seconds) {
    for (const double time : {0.2, 0.5, 1.0, 2.0, 4.0, 10.0}) {
        if (time > seconds) {
            break;
        }
        const Json* best = nullptr;
        double least = 1e30;
        for (const Json& curve : curves) {
            for (const Json& point : curve["points"]) {
                const double error = point["relRMSE"].get<double>();
                if (point["seconds"].get<double>() <= time * 1.1 && error < least) {
                    least = error;
                    best = &curve;
                }
            }
        }
        if (best != nullptr) {
            fmt::print("    {:4.1f} s after the move: {:6.2f} % with {}\n", time, 100.0 * least,
                       (*best)["name"].get<std::string>());
        }
    }
}

void draw(const std::string& file, const std::string& scene, const std::vector<Variant>& all,
          const Json& curves) {
    LinePlot plot;
    plot.title = "Error after a move: " + scene;
    plot.description = "relRMSE against a converged fresh solve over the time since the move";
    plot.x = {"time since the move", " s", AxisScale::logarithmic};
    plot.y = {"relRMSE", " %", AxisScale::logarithmic};
    for (std::size_t i = 0; i < curves.size(); ++i) {
        PlotSeries series;
        series.name = all[i].name;
        series.dashed = !all[i].scissored;
        series.style = all[i].style;
        for (const Json& point : curves[i]["points"]) {
            series.points.push_back({point["seconds"].get<double>(),
                                     100.0 * point["relRMSE"].get<double>(), std::nullopt, true});
        }
        plot.series.push_back(std::move(series));
    }
    write_file(file, svg_of(plot));
}

}  // namespace

Json bench_moves(const LoadedScene& loaded, std::uint64_t seed, std::optional<double> seconds,
                 const std::string& svg) {
    const auto& objects = loaded.scene.objects;
    const auto found =
        std::find_if(objects.begin(), objects.end(), [](const Object& o) { return o.movable; });
    if (found == objects.end()) {
        return nullptr;
    }
    const Effort effort = effort_for(seconds);
    const std::vector<Variant> all = variants(effort);
    const MoveBench bench(loaded, static_cast<std::uint32_t>(found - objects.begin()), seed,
                          effort);
    fmt::print(
        "  error after moving '{}' by {} m, 256x256, against {} iterations of another seed (and "
        "`settled`):\n",
        found->name, move_m, bench.reference_iterations());
    Json curves = Json::array();
    for (const Variant& variant : all) {
        curves.push_back(bench.measure(variant));
        std::string line;
        for (const Json& point : curves.back()["points"]) {
            line +=
                fmt::format(" {:.2f}s {:.1f}% ({:.2f})", point["seconds"].get<double>(),
                            100.0 * point["relRMSE"].get<double>(), point["settled"].get<double>());
        }
        fmt::print("    {:<24}{}\n", variant.name, line);
        std::fflush(stdout);
    }
    print_winners(curves, effort.seconds);
    if (!svg.empty()) {
        draw(svg, loaded.scene.name, all, curves);
    }
    return {{"object", found->name},
            {"metres", move_m},
            {"referenceIterations", bench.reference_iterations()},
            {"curves", std::move(curves)}};
}

}  // namespace raybundle
