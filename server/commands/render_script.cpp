// SPDX-License-Identifier: Apache-2.0
// `raybundle render --script`: an image sequence whose frames share one solution.
#include <spdlog/spdlog.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/render_job.h"
#include "bundle/low_discrepancy.h"
#include "commands/command.h"
#include "gpu/egl_context.h"
#include "scene/animation_script.h"
#include "scene/mesh/geometry_defects.h"
#include "transport/solver.h"
#include "view/image/image_file.h"
#include "view/viewer_image.h"

namespace raybundle {

namespace {

constexpr std::uint64_t least_iterations =
    2 * GROUP_SIZE;  // of a frame, for an estimate of its error

std::string read_text(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw UsageError("--script: cannot read '" + file + "'");
    }
    return {std::istreambuf_iterator<char>(stream), {}};
}

template <typename T>
void append(const std::vector<T>& more, std::vector<T>& to) {
    to.insert(to.end(), more.begin(), more.end());
}

/// The scene as it changes, its solution and the picture.
class Sequence {
  public:
    Sequence(LoadedScene loaded, const AnimationScript& script, const SolverSettings& settings,
             const TessellationSettings& tessellation, glm::uvec2 size)
        : loaded_(std::move(loaded)),
          script_(script),
          settings_(settings),
          tessellation_(tessellation),
          size_(size) {
        if (loaded_.scene.animations && !loaded_.scene.animations->shapes.empty()) {
            all_triangles_ = loaded_.scene.triangles;
        }
        solver_ = std::make_unique<Solver>(loaded_.scene, loaded_.mesh, settings_);
        make_image();
    }

    /// Brings everything to a time; `before` is that of the frame before, negative for the first.
    void go_to(double before, double time) {
        if (deform(time)) {
            begin_anew(before, time);
            return;
        }
        change_surfaces(before, time);
        const std::vector<ObjectMove> moves = move_all(time);
        for (std::size_t first = 0; first < moves.size(); first += MOST_MOVED) {
            const std::size_t count = std::min<std::size_t>(moves.size() - first, MOST_MOVED);
            solver_->move_objects(std::span(moves).subspan(first, count), receivers());
            correct();
        }
        image_->set_camera(script_.camera_at(time));
    }

    /// Iterates until the rule is met; returns the frame's figures.
    nlohmann::ordered_json solve(const StopRule& rule) {
        const std::uint64_t first = solver_->iterations();
        const Stopwatch stopwatch;
        double progress = 0.0;
        std::uint64_t done = 0;
        while (progress < 1.0) {
            solver_->step(receivers());
            done = solver_->iterations() - first;
            if (done % GROUP_SIZE == 0) {
                image_->request_statistics();
                glFinish();
                const double error =
                    done < least_iterations ? 1e9 : rule.estimate_of(image_->statistics());
                progress = rule.progress(stopwatch.seconds(), done, error);
            } else {
                progress = rule.needs_error() ? 0.0 : rule.progress(stopwatch.seconds(), done, 1e9);
            }
        }
        const ImageStatistics& statistics = image_->statistics();
        return {{"seconds", stopwatch.seconds()},
                {"iterations", done},
                {"relativeError", statistics.relative_error},
                {"errorLow", statistics.error_low},
                {"errorHigh", statistics.error_high},
                {"settled", solver_->statistics().settled}};
    }

    /// One exposure for all pictures: a lamp that is dimmed shall be seen to be.
    void write(const std::string& path) {
        const auto width = static_cast<int>(size_.x);
        const auto height = static_cast<int>(size_.y);
        if (is_exr(path)) {
            write_exr(path, width, height, image_->read_radiance());
            return;
        }
        if (!exposure_) {
            image_->request_statistics();
            glFinish();
            image_->statistics();
            exposure_ = image_->automatic_exposure();
        }
        image_->compose(DisplayMode::photo, *exposure_);
        write_png(path, width, height, image_->take());
    }

  private:
    /// Whether something is of another shape than before. Triangles that lose their area are left
    /// out as long as they have none.
    bool deform(double time) {
        Scene& scene = loaded_.scene;
        if (!scene.animations || scene.animations->shapes.empty()) {
            return false;
        }
        std::vector<Triangle> shown = std::exchange(scene.triangles, all_triangles_);
        if (!script_.playback().deform(scene, time)) {
            scene.triangles = std::move(shown);
            return false;
        }
        return true;
    }

    /// They are cut into patches anew, and all light begins anew, too.
    void begin_anew(double before, double time) {
        image_.reset();
        programs_.reset();
        solver_.reset();
        for (const LightEdit& edit : light_edits(before, time)) {
            apply(loaded_.scene, edit);
        }
        for (const MaterialEdit& edit : material_edits(before, time)) {
            apply(loaded_.scene, edit);
        }
        move_all(time);
        remove_degenerate_triangles(loaded_.scene);
        loaded_.mesh = tessellate(loaded_.scene, tessellation_);
        solver_ = std::make_unique<Solver>(loaded_.scene, loaded_.mesh, settings_);
        make_image();
        image_->set_camera(script_.camera_at(time));
    }

    [[nodiscard]] std::vector<LightEdit> light_edits(double before, double time) const {
        std::vector<LightEdit> edits = script_.lights_between(before, time);
        append(script_.playback().lights_between(loaded_.scene, before, time), edits);
        return edits;
    }

    [[nodiscard]] std::vector<MaterialEdit> material_edits(double before, double time) const {
        std::vector<MaterialEdit> edits = script_.materials_between(before, time);
        append(script_.playback().materials_between(loaded_.scene, before, time), edits);
        return edits;
    }

    /// Puts the objects where they are at a time; returns those that were elsewhere.
    std::vector<ObjectMove> move_all(double time) {
        std::vector<ObjectMove> moves;
        for (const std::uint32_t object : script_.moving_objects()) {
            move(object, script_.transform_at(object, time), moves);
        }
        for (const auto& [object, transform] : script_.playback().objects_at(loaded_.scene, time)) {
            move(object, transform, moves);
        }
        return moves;
    }

    void make_image() {
        programs_ = std::make_unique<ViewPrograms>(solver_->scene());
        image_ =
            std::make_unique<ViewerImage>(solver_->scene(), solver_->store(), *programs_, size_);
        receivers_ = {image_.get()};
    }

    [[nodiscard]] std::span<BundleReceiver* const> receivers() const { return receivers_; }

    void correct() {
        while (solver_->correcting()) {
            solver_->step(receivers());
        }
    }

    void move(std::uint32_t object, const Transform& transform, std::vector<ObjectMove>& moves) {
        Object& moved = loaded_.scene.objects[object];
        if (transform.matrix() != moved.transform.matrix()) {
            moved.transform = transform;
            moves.push_back({object, moved.world_from_object()});
        }
    }

    void change_surfaces(double before, double time) {
        std::vector<std::uint32_t> materials;
        std::vector<std::uint32_t> reflecting;
        bool lights = false;
        const std::vector<float> cones = outer_cones(loaded_.scene);
        for (const LightEdit& edit : light_edits(before, time)) {
            lights = true;
            const std::uint32_t material = apply(loaded_.scene, edit);
            if (material != no_material) {
                materials.push_back(material);
            }
        }
        bool covered = same_cones(loaded_.scene, cones) && solver_->covers_lights(loaded_.scene);
        for (const MaterialEdit& edit : material_edits(before, time)) {
            const std::uint32_t material = apply(loaded_.scene, edit);
            materials.push_back(material);
            reflecting.push_back(material);
            covered = covered && solver_->covers(loaded_.scene, material);
        }
        if (materials.empty() && !lights) {
            return;
        }
        if (covered) {
            solver_->change_surfaces(loaded_.scene, loaded_.mesh, materials, reflecting,
                                     receivers());
        } else {
            refresh_surfaces(loaded_.scene, materials, loaded_.mesh);
            settings_.seed = mix_bits(settings_.seed);
            const std::unique_ptr<Solver> old = std::move(solver_);
            const Camera camera = image_->camera();
            image_.reset();
            solver_ = std::make_unique<Solver>(loaded_.scene, loaded_.mesh, settings_);
            make_image();
            image_->set_camera(camera);
            solver_->take_over(*old, reflecting, receivers());
        }
        correct();
    }

    LoadedScene loaded_;
    const AnimationScript& script_;
    SolverSettings settings_;
    TessellationSettings tessellation_;
    std::vector<Triangle> all_triangles_;  // as loaded, where some deform
    glm::uvec2 size_;
    std::unique_ptr<Solver> solver_;
    std::unique_ptr<ViewPrograms> programs_;
    std::unique_ptr<ViewerImage> image_;
    std::vector<BundleReceiver*> receivers_;
    std::optional<float> exposure_;
};

}  // namespace

namespace {

/// The script's text, as far as it can be right without a scene.
std::string script_text(const Options& options) {
    try {
        numbered_file(options.output.file, 0);
        std::string text = read_text(options.render.script);
        AnimationScript::require_json(text, options.render.script);
        return text;
    } catch (const ScriptError& error) {
        throw UsageError(error.what());
    }
}

AnimationScript read_script(const std::string& text, const Options& options, const Scene& scene) {
    try {
        return {text, options.render.script, scene, choose_camera(scene, options)};
    } catch (const ScriptError& error) {
        throw UsageError(error.what());
    }
}

}  // namespace

int run_render_script(const StrategyProbabilities& probabilities, glm::uvec2 size,
                      const Options& options) {
    const std::string text = script_text(options);  // before a scene that takes long
    LoadedScene loaded = load_scene(options);
    const AnimationScript script = read_script(text, options, loaded.scene);
    const StopRule rule(options);
    const EglContext context = create_egl_context({options.device.gpu, false});
    SolverSettings settings;
    settings.seed = options.scene.seed;
    settings.probabilities = probabilities;
    nlohmann::ordered_json report = {{"scene", loaded.scene.name},
                                     {"device", context.renderer()},
                                     {"script", options.render.script},
                                     {"frames", nlohmann::ordered_json::array()}};
    Sequence sequence(std::move(loaded), script, settings, tessellation_settings(options), size);
    double before = -1.0;
    for (unsigned frame = 0; frame < script.frames(); ++frame) {
        const double time = script.time_of(frame);
        sequence.go_to(before, time);
        before = time;
        nlohmann::ordered_json figures = sequence.solve(rule);
        const std::string path = numbered_file(options.output.file, frame);
        sequence.write(path);
        spdlog::info("{}: {} iterations in {:.2f} s, estimated error {:.2f} %", path,
                     figures["iterations"].get<std::uint64_t>(), figures["seconds"].get<double>(),
                     100.0 * figures["relativeError"].get<double>());
        figures["file"] = path;
        figures["time"] = time;
        report["frames"].push_back(std::move(figures));
    }
    if (!options.render.stats.empty()) {
        write_file(options.render.stats, report.dump(2) + "\n");
    }
    return exit_done;
}

}  // namespace raybundle
