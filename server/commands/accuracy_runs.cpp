// SPDX-License-Identifier: Apache-2.0
#include "commands/accuracy_runs.h"

#include <fmt/core.h>

#include <functional>

#include "app/render_job.h"
#include "research/reference_method.h"
#include "transport/solver.h"
#include "view/final_picture.h"

namespace raybundle {
namespace {

using Json = nlohmann::ordered_json;

/// Counts solving time alone.
class SolvingClock {
  public:
    [[nodiscard]] double seconds() const { return before_ + (running_ ? stretch_.seconds() : 0.0); }
    void pause() {
        before_ = seconds();
        running_ = false;
    }
    void resume() {
        stretch_ = Stopwatch();
        running_ = true;
    }

  private:
    Stopwatch stretch_;
    double before_ = 0.0;
    bool running_ = true;
};

/// Steps a method until its time is over and has it measured at the checkpoints. step: does some
/// work and waits for its end; measure: what the method has reached, seconds and checkpoint aside.
std::vector<RunCheckpoint> run_checkpoints(const RunSurroundings& around,
                                           const std::function<void()>& step,
                                           const std::function<RunCheckpoint()>& measure) {
    const std::vector<double> times = checkpoint_times(around.seconds);
    std::vector<RunCheckpoint> result;
    SolvingClock clock;
    for (std::size_t next = 0; next < times.size();) {
        step();
        const double now = clock.seconds();
        around.progress.show(now / around.seconds, around.seconds - now + around.seconds_after,
                             fmt::format("{:.1f} of {:.1f} s", now, around.seconds));
        if (now < times[next]) {
            continue;
        }
        // A slow step may pass several checkpoints: it is measured at the last of them.
        while (next < times.size() && times[next] <= now) {
            ++next;
        }
        clock.pause();
        result.push_back(measure());
        result.back().point.checkpoint = static_cast<unsigned>(next - 1);
        result.back().point.seconds = now;
        clock.resume();
    }
    return result;
}

std::vector<glm::dvec3> rgb_of(const std::vector<glm::vec4>& pixels) {
    std::vector<glm::dvec3> result;
    result.reserve(pixels.size());
    for (const glm::vec4& pixel : pixels) {
        result.emplace_back(pixel);
    }
    return result;
}

Json json_of(const BundleResolution& resolution) {
    return {resolution.hemicube, resolution.window};
}

Json bundle_settings(const PlannedCurve& curve, const RunSurroundings& around, const Solver& solver,
                     const FinalPicture& picture, std::uint64_t seed) {
    const SolverSettings& s = curve.solver;
    Json bundles = {{"first", json_of(s.coarse)}};
    if (s.coarse_iterations < std::numeric_limits<std::uint64_t>::max()) {
        bundles["later"] = json_of(s.fine);
        bundles["laterFromIteration"] = s.coarse_iterations;
    }
    return {{"patches", around.mesh.patch_count()},
            {"bundleResolution", bundles},
            {"probabilities",
             {s.probabilities.layered, s.probabilities.plane, s.probabilities.perspective}},
            {"biasForNoise", s.noise_horizon},
            {"mainPart", s.main_part},
            {"constantRadiance", s.constant_radiance},
            {"randomFaces", s.random_faces},
            {"pixelGrid", picture.pixel_grid()},
            {"bytes", solver.bytes() + picture.bytes()},
            {"seed", seed}};
}

}  // namespace

MethodRun run_bundles(const RunSurroundings& around, const PlannedCurve& curve,
                      std::uint64_t seed) {
    SolverSettings settings = curve.solver;
    settings.seed = seed;
    Solver solver(around.scene, around.mesh, settings);
    const ViewPrograms programs(solver.scene());
    FinalPicture picture(solver.scene(), solver.store(), programs, around.camera, around.size,
                         curve.grid);
    picture.check_by(
        spot_check(around.whole_scene, around.whole_mesh, around.camera, around.size, seed));
    BundleReceiver* const receivers[] = {&picture.receiver()};
    glFinish();
    const auto step = [&] {
        picture.prepare();  // within the time, as `render` does
        solver.step(receivers);
        glFinish();
    };
    const auto measure = [&] {
        const ImageStatistics& statistics = picture.measure();
        RunCheckpoint checkpoint;
        checkpoint.point.iterations = solver.iterations();
        checkpoint.point.estimated_error = statistics.relative_error;
        checkpoint.point.estimated_low = statistics.known ? statistics.error_low : 0.0;
        checkpoint.point.estimated_high = statistics.error_high;
        checkpoint.picture = around.pictures.add(rgb_of(picture.read_radiance()));
        return checkpoint;
    };
    MethodRun run{run_checkpoints(around, step, measure), {}};
    run.settings = bundle_settings(curve, around, solver, picture, seed);
    return run;
}

MethodRun run_on_cpu(const RunSurroundings& around, const RayScene& ray_scene, ReferenceKind kind,
                     std::uint64_t seed) {
    const auto method = make_reference_method(kind, ray_scene, around.camera, around.size, seed);
    const auto measure = [&] {
        const ImageError error = method->error();
        RunCheckpoint checkpoint;
        checkpoint.point.iterations = method->iterations();
        checkpoint.point.estimated_error = error.relative;
        checkpoint.point.estimated_low = error.low;
        checkpoint.point.estimated_high = error.high;
        checkpoint.picture = around.pictures.add(method->picture());
        return checkpoint;
    };
    MethodRun run{run_checkpoints(
                      around, [&] { method->iterate(); }, measure),
                  {}};
    run.settings = {{"bytes", method->bytes()}, {"seed", seed}};
    return run;
}

}  // namespace raybundle
