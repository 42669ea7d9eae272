// SPDX-License-Identifier: Apache-2.0
#include "commands/bench/bench_changes.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gpu/gl_scope.h"
#include "transport/solver.h"
#include "view/viewer_image.h"

namespace raybundle {

namespace {

using Json = nlohmann::ordered_json;

constexpr glm::uvec2 resting_picture(640, 400);
constexpr int iterations_before_changes = 64;
constexpr int change_repeats = 9;  // of each change; the first is not counted
constexpr float door_turn = 0.5F;
constexpr float lamp_dim = 0.5F;

double wall_ms() {
    return std::chrono::duration<double, std::milli>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Of all threads.
double processor_ms() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_nsec);
}

double median_of_times(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

std::optional<std::uint32_t> find_door(const Scene& scene) {
    std::optional<std::uint32_t> found;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        const bool door = scene.objects[i].name.find("door") != std::string::npos;
        if (scene.objects[i].movable && (door || !found)) {
            found = i;
            if (door) {
                break;
            }
        }
    }
    return found;
}

class ChangeBench {
  public:
    ChangeBench(const LoadedScene& loaded, std::uint64_t seed)
        : scene_(loaded.scene),
          mesh_(loaded.mesh),
          solver_(scene_, mesh_, settings(seed)),
          programs_(solver_.scene()),
          image_(solver_.scene(), solver_.store(), programs_, resting_picture) {
        image_.set_camera(scene_.cameras.front());
        image_.rest();
        for (int i = 0; i < iterations_before_changes; ++i) {
            solver_.step(receivers_);
        }
    }

    Json move_door() {
        const auto door = find_door(scene_);
        if (!door) {
            return nullptr;
        }
        Object object = scene_.objects[*door];
        const glm::quat closed = object.transform.rotation;
        bool open = false;
        return measure("'" + object.name + "' turns", [&] {
            open = !open;
            object.transform.rotation =
                open ? closed * glm::angleAxis(door_turn, glm::vec3(0.0F, 1.0F, 0.0F)) : closed;
            scene_.objects[*door] = object;
            solver_.move_object(*door, object.world_from_object(), receivers_);
        });
    }

    Json dim_lamp() {
        const auto lamp = std::find_if(
            scene_.punctual_lights.begin(), scene_.punctual_lights.end(),
            [](const PunctualLight& light) { return light.intensity != glm::vec3(0.0F); });
        if (lamp == scene_.punctual_lights.end()) {
            return nullptr;
        }
        const glm::vec3 full = lamp->intensity;
        bool dimmed = false;
        return measure("'" + lamp->name + "' dims", [&] {
            dimmed = !dimmed;
            lamp->intensity = dimmed ? lamp_dim * full : full;
            solver_.change_surfaces(scene_, mesh_, {}, {}, receivers_);
        });
    }

    /// A group of iterations as they come, of an iteration.
    Json iterate() {
        return measure(
            "iteration", [&] { step(8); }, 8);
    }

  private:
    static SolverSettings settings(std::uint64_t seed) {
        SolverSettings s;
        s.seed = seed;
        s.special = interactive_special();
        return s;
    }

    void step(int count) {
        for (int i = 0; i < count; ++i) {
            solver_.step(receivers_);
        }
    }

    /// Parts that `change` is made of are so many.
    Json measure(const std::string& name, const std::function<void()>& change, double parts = 1) {
        std::vector<double> wall;
        std::vector<double> processor;
        const auto once = [&] {
            change();
            while (solver_.correcting()) {
                solver_.step(receivers_);
            }
            image_.compose(DisplayMode::photo, -6.0F);
            image_.take();
        };
        for (int i = 0; i < change_repeats; ++i) {
            step(8);
            glFinish();
            const double wall_before = wall_ms();
            const double processor_before = processor_ms();
            once();
            glFinish();
            if (i > 0) {
                wall.push_back((wall_ms() - wall_before) / parts);
                processor.push_back((processor_ms() - processor_before) / parts);
            }
        }
        Json result = {{"medianMs", median_of_times(wall)},
                       {"leastMs", *std::min_element(wall.begin(), wall.end())},
                       {"processorMs", median_of_times(processor)}};
        fmt::print("  {:<52} {:8.2f} ms  (least {:8.2f} ms, processor {:8.2f} ms)\n", name,
                   result["medianMs"].get<double>(), result["leastMs"].get<double>(),
                   result["processorMs"].get<double>());
        Json& profile = result["profile"];
        constexpr int profiled = 4;
        start_gl_profile();
        for (int i = 0; i < profiled; ++i) {
            once();
        }
        for (const GlProfileEntry& entry : stop_gl_profile()) {
            const double ms = entry.milliseconds / profiled / parts;
            profile[entry.label] = ms;
            if (ms > 0.01 * result["medianMs"].get<double>()) {
                fmt::print("      {:<48} {:8.2f} ms\n", entry.label, ms);
            }
        }
        std::fflush(stdout);
        return result;
    }

    Scene scene_;
    PatchMesh mesh_;
    Solver solver_;
    ViewPrograms programs_;
    ViewerImage image_;
    BundleReceiver* const receivers_[1] = {&image_};
};

}  // namespace

Json bench_changes(const LoadedScene& loaded, std::uint64_t seed) {
    fmt::print("  change to corrected frame at rest, {}x{}:\n", resting_picture.x,
               resting_picture.y);
    ChangeBench bench(loaded, seed);
    return {
        {"iteration", bench.iterate()}, {"door", bench.move_door()}, {"lamp", bench.dim_lamp()}};
}

}  // namespace raybundle
