// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "commands/bench/bench_changes.h"
#include "commands/bench/bench_moves.h"
#include "commands/command.h"
#include "gpu/egl_context.h"
#include "gpu/gl_scope.h"
#include "transport/solver.h"
#include "view/image/whole_file.h"
#include "view/viewer_image.h"

namespace raybundle {

namespace {

using Clock = std::chrono::steady_clock;
using Json = nlohmann::ordered_json;

constexpr glm::uvec2 viewer_size(800, 800);
constexpr glm::uvec2 small_picture(512, 512);
constexpr glm::uvec2 large_picture(1920, 1080);
constexpr std::size_t many_patches = 240'000;

/// Milliseconds of `repeats` runs, GPU work included; median and 95th percentile.
Json measure(int repeats, const std::function<void()>& work) {
    work();
    glFinish();
    std::vector<double> times;
    for (int i = 0; i < repeats; ++i) {
        const auto start = Clock::now();
        work();
        glFinish();
        times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    std::sort(times.begin(), times.end());
    const auto at = [&](double share) {
        return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))];
    };
    return {{"medianMs", at(0.5)}, {"p95Ms", at(0.95)}, {"perSecond", 1000.0 / at(0.5)}};
}

void print(const std::string& name, const Json& result) {
    fmt::print("  {:<52} {:8.2f} ms  (p95 {:8.2f} ms, {:7.1f} /s)\n", name,
               result["medianMs"].get<double>(), result["p95Ms"].get<double>(),
               result["perSecond"].get<double>());
    std::fflush(stdout);
}

/// Where the time of `work` goes: milliseconds per run and label of GL work.
Json profile(int repeats, const std::function<void()>& work) {
    glFinish();
    start_gl_profile();
    for (int i = 0; i < repeats; ++i) {
        work();
    }
    Json result = Json::object();
    const auto entries = stop_gl_profile();
    double total = 0.0;
    for (const GlProfileEntry& entry : entries) {
        total += entry.milliseconds / repeats;
    }
    for (const GlProfileEntry& entry : entries) {
        const double milliseconds = entry.milliseconds / repeats;
        result[entry.label] = milliseconds;
        if (milliseconds > 0.02 * total) {
            fmt::print("      {:<48} {:8.2f} ms\n", entry.label, milliseconds);
        }
    }
    return result;
}

class SceneBench {
  public:
    SceneBench(const Options& options, Json& report)
        : report_(report),
          seed_(options.scene.seed),
          seconds_(options.stop.seconds),
          json_file_(options.output.json_file),
          changes_only_(options.bench.changes),
          loaded_(load_scene(options)) {
        report_["scene"] = loaded_.scene.name;
        report_["patches"] = loaded_.mesh.patch_count();
        report_["loadSeconds"] = loaded_.seconds;
        fmt::print("{}: {} patches\n", loaded_.scene.name, loaded_.mesh.patch_count());
    }

    void run() {
        if (changes_only_) {
            report_["changes"] = bench_changes(loaded_, seed_);
            return;
        }
        iterations("perspective iteration, 512-pixel hemicube", {0, 0, 1}, false);
        iterations("layered iteration, 800-pixel window", {1, 0, 0}, false);
        iterations("plane iteration, 800-pixel window", {0, 1, 0}, false);
        iterations("combined iteration with an 800x800 viewer", {}, true);
        patch_counts();
        walkthrough();
        beside_frames();
        moves();
        report_["changes"] = bench_changes(loaded_, seed_);
        const std::string svg = json_file_.empty() ? "" : json_file_ + ".moves.svg";
        report_["moveCurves"] = bench_moves(loaded_, seed_, seconds_, svg);
        convergence();
    }

  private:
    SolverSettings settings(const StrategyProbabilities& probabilities) const {
        SolverSettings result;
        result.seed = seed_;
        result.probabilities = probabilities;
        result.special = interactive_special();
        return result;
    }

    /// What ten times as many patches cost, with the bundles of the dissertation's figures.
    void patch_counts() {
        Scene copy = loaded_.scene;
        TessellationSettings finer;
        finer.target_patches = many_patches;
        const PatchMesh many = tessellate(copy, finer);
        for (const auto& [strategy, probabilities] :
             {std::pair<std::string, StrategyProbabilities>{"perspective", {0, 0, 1}},
              {"layered", {1, 0, 0}}}) {
            double few_ms = 0.0;
            for (const PatchMesh* mesh :
                 std::initializer_list<const PatchMesh*>{&loaded_.mesh, &many}) {
                const std::string name = fmt::format(
                    "{} iteration, {} patches, {}", strategy, mesh->patch_count(),
                    probabilities.layered > 0.0F ? "1000-pixel window" : "600-pixel hemicube");
                iterations(name, probabilities, false, *mesh, {600, 1000});
                const auto ms = report_["iteration"][name]["medianMs"].get<double>();
                if (mesh == &many) {
                    fmt::print("      {:.1f} times the patches cost {:.2f} times the time\n",
                               static_cast<double>(many.patch_count()) /
                                   static_cast<double>(loaded_.mesh.patch_count()),
                               ms / few_ms);
                    report_["manyPatches"][strategy] = ms / few_ms;
                }
                few_ms = ms;
            }
        }
    }

    void iterations(const std::string& name, const StrategyProbabilities& probabilities,
                    bool viewed) {
        iterations(name, probabilities, viewed, loaded_.mesh, SolverSettings{}.fine);
    }

    void iterations(const std::string& name, const StrategyProbabilities& probabilities,
                    bool viewed, const PatchMesh& mesh, const BundleResolution& resolution) {
        SolverSettings s = settings(probabilities);
        s.coarse_iterations = 0;
        s.fine = resolution;
        s.adapt_probabilities = false;
        Solver solver(loaded_.scene, mesh, s);
        const ViewPrograms programs(solver.scene());
        ViewerImage image(solver.scene(), solver.store(), programs, viewer_size);
        image.set_camera(loaded_.scene.cameras.front());
        std::vector<BundleReceiver*> receivers;
        if (viewed) {
            receivers.push_back(&image);
        }
        for (int i = 0; i < 16; ++i) {
            solver.step(receivers);
        }
        report_["iteration"][name] = measure(48, [&] { solver.step(receivers); });
        print(name, report_["iteration"][name]);
        report_["profile"][name] = profile(16, [&] { solver.step(receivers); });
    }

    /// Frames of a camera in motion, with one iteration between frames as the server does.
    void walkthrough() {
        Solver solver(loaded_.scene, loaded_.mesh, settings({}));
        const ViewPrograms programs(solver.scene());
        ViewerImage image(solver.scene(), solver.store(), programs, viewer_size);
        Camera camera = loaded_.scene.cameras.front();
        image.set_camera(camera);
        BundleReceiver* const receivers[] = {&image};
        for (int i = 0; i < 32; ++i) {
            solver.step(receivers);
        }
        const auto frame = [&] {
            camera.eye += 0.01F * glm::normalize(camera.target - camera.eye);
            image.set_camera(camera);
            image.compose(DisplayMode::photo, -6.0F);
            image.take();
        };
        report_["frame"] = measure(40, frame);
        print("frame of a moving camera, 800x800, read back", report_["frame"]);
        report_["profile"]["frame of a moving camera"] = profile(16, frame);
        report_["frameAndIteration"] = measure(40, [&] {
            frame();
            solver.step(receivers);
        });
        print("the same with an iteration in between", report_["frameAndIteration"]);
        report_["geometry"] = measure(20, [&] { image.set_camera(camera); });
        print("geometry buffer, 800x800", report_["geometry"]);
        report_["geometryAndEdges"] = measure(20, [&] {
            image.set_camera(camera);
            image.smooth();
        });
        print("the same and all slices of antialiasing", report_["geometryAndEdges"]);
        const auto resting = [&] {
            image.compose(DisplayMode::photo, -6.0F);
            image.take();
        };
        report_["smoothFrame"] = measure(40, resting);
        print("frame at rest with smooth edges, read back", report_["smoothFrame"]);
        image.set_camera(camera);
        report_["plainFrame"] = measure(40, resting);
        print("the same without", report_["plainFrame"]);
    }

    /// How often the solver gets to iterate while a camera moves in a large picture that is wanted
    /// 60 times a second: for two seconds, frames when they are due, iterations between them, one
    /// at least.
    void beside_frames() {
        constexpr double wanted_per_second = 60.0;
        constexpr double seconds = 2.0;
        Solver solver(loaded_.scene, loaded_.mesh, settings({}));
        const ViewPrograms programs(solver.scene());
        ViewerImage image(solver.scene(), solver.store(), programs, large_picture);
        Camera camera = loaded_.scene.cameras.front();
        image.set_camera(camera);
        BundleReceiver* const receivers[] = {&image};
        for (int i = 0; i < 32; ++i) {
            solver.step(receivers);
        }
        glFinish();
        const std::uint64_t before = solver.iterations();
        const auto start = Clock::now();
        const auto elapsed = [&] {
            return std::chrono::duration<double>(Clock::now() - start).count();
        };
        int frames = 0;
        bool iterated = true;
        while (elapsed() < seconds) {
            if (iterated && elapsed() * wanted_per_second >= static_cast<double>(frames)) {
                camera.eye += 0.002F * glm::normalize(camera.target - camera.eye);
                image.set_camera(camera);
                image.compose(DisplayMode::photo, -6.0F);
                image.take();
                ++frames;
                iterated = false;
            } else {
                solver.step(receivers);
                iterated = true;
            }
        }
        glFinish();
        const double iterations_per_second =
            static_cast<double>(solver.iterations() - before) / elapsed();
        const double frames_per_second = frames / elapsed();
        fmt::print("  beside a moving camera, {}x{}: {:.0f} iterations/s and {:.1f} frames/s\n",
                   large_picture.x, large_picture.y, iterations_per_second, frames_per_second);
        report_["besideFrames"] = {{"size", {large_picture.x, large_picture.y}},
                                   {"iterationsPerSecond", iterations_per_second},
                                   {"framesPerSecond", frames_per_second}};
    }

    void moves() {
        const auto& objects = loaded_.scene.objects;
        const auto found =
            std::find_if(objects.begin(), objects.end(), [](const Object& o) { return o.movable; });
        if (found == objects.end()) {
            return;
        }
        const auto index = static_cast<std::uint32_t>(found - objects.begin());
        Solver solver(loaded_.scene, loaded_.mesh, settings({}));
        const ViewPrograms programs(solver.scene());
        ViewerImage image(solver.scene(), solver.store(), programs, viewer_size);
        image.set_camera(loaded_.scene.cameras.front());
        BundleReceiver* const receivers[] = {&image};
        for (int i = 0; i < 32; ++i) {
            solver.step(receivers);
        }
        Object object = *found;
        float step = 0.1F;
        const auto move = [&] {
            object.transform.translation.x += step;
            step = -step;
            solver.move_object(index, object.world_from_object(), receivers);
            while (solver.correcting()) {
                solver.step(receivers);
            }
            image.compose(DisplayMode::photo, -6.0F);
            image.take();
        };
        report_["move"] = measure(12, move);
        print("move of '" + object.name + "' to corrected frame", report_["move"]);
        report_["profile"]["move to corrected frame"] = profile(12, move);
    }

    /// Error of a 512x512 picture against a longer run of another seed.
    void convergence() {
        const auto picture = [&](std::uint64_t seed, double seconds, std::uint64_t& iterations) {
            SolverSettings s = settings({});
            s.seed = seed;
            Solver solver(loaded_.scene, loaded_.mesh, s);
            const ViewPrograms programs(solver.scene());
            ViewerImage image(solver.scene(), solver.store(), programs, small_picture);
            image.set_camera(loaded_.scene.cameras.front());
            BundleReceiver* const receivers[] = {&image};
            const auto start = Clock::now();
            while (std::chrono::duration<double>(Clock::now() - start).count() < seconds) {
                solver.step(receivers);
                glFinish();
            }
            iterations = solver.iterations();
            return image.read_radiance();
        };
        std::uint64_t iterations = 0;
        const double reference_seconds = 40.0;
        const auto reference = picture(seed_ + 1000, reference_seconds, iterations);
        fmt::print("  error against {} s of another seed ({} iterations), 512x512:\n",
                   reference_seconds, iterations);
        for (const double seconds : {1.0, 2.0, 5.0, 10.0}) {
            const auto image = picture(seed_, seconds, iterations);
            const double error = relative_rmse(image, reference);
            fmt::print("    {:4.0f} s: relRMSE {:.2f} %, {} iterations\n", seconds, 100.0 * error,
                       iterations);
            std::fflush(stdout);
            report_["convergence"].push_back(
                {{"seconds", seconds}, {"iterations", iterations}, {"relRMSE", error}});
        }
    }

    /// design: sqrt(sum (I-R)^2 / sum R^2); pixels that see an emitter are left out by their
    /// brightness.
    static double relative_rmse(const std::vector<glm::vec4>& image,
                                const std::vector<glm::vec4>& reference) {
        double error = 0.0;
        double total = 0.0;
        double mean = 0.0;
        for (const glm::vec4& r : reference) {
            mean += static_cast<double>(r.g) / static_cast<double>(reference.size());
        }
        for (std::size_t i = 0; i < reference.size(); ++i) {
            if (static_cast<double>(reference[i].g) > 20.0 * mean) {
                continue;
            }
            for (int c = 0; c < 3; ++c) {
                const double d =
                    static_cast<double>(image[i][c]) - static_cast<double>(reference[i][c]);
                error += d * d;
                total +=
                    static_cast<double>(reference[i][c]) * static_cast<double>(reference[i][c]);
            }
        }
        return total > 0.0 ? std::sqrt(error / total) : 0.0;
    }

    Json& report_;
    std::uint64_t seed_;
    std::optional<double> seconds_;
    std::string json_file_;
    bool changes_only_;
    LoadedScene loaded_;
};

}  // namespace

int run_bench(const Options& options) {
    if (!options.output.json_file.empty()) {
        require_writable(options.output.json_file);
    }
    const EglContext context = create_egl_context({options.device.gpu, false});
    Json report = {{"device", context.renderer()}};
    fmt::print("device: {}\n", context.renderer());
    Options chosen = options;
    if (chosen.scene.file.empty()) {
        chosen.scene.file = "scenes/cornell_box.gltf";
    }
    SceneBench(chosen, report).run();
    if (!options.output.json_file.empty()) {
        write_file(options.output.json_file, report.dump(2) + "\n");
    }
    return exit_done;
}

}  // namespace raybundle
