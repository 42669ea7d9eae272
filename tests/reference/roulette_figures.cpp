// SPDX-License-Identifier: Apache-2.0
// Prints the data of the dissertation's figures 3.6 to 3.8 as JSON, and what eq. 3.16 expects.
#include <cstdio>
#include <exception>
#include <nlohmann/json.hpp>

#include "roulette_study.h"

namespace {

using namespace raybundle;

constexpr std::uint32_t walks = 2'000;
constexpr int bounces = 7;  // of eq. 3.16, as far as its figures go

nlohmann::ordered_json curve(const char* name, const WalkScene& walk_scene) {
    const RayScene scene(walk_scene.builder.scene, walk_scene.builder.mesh);
    const WalkStatistics statistics =
        measure_walks(scene, CameraRays(scene, walk_scene.camera, study_size), 1024, 1);
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (int tenth = 1; tenth <= 9; ++tenth) {
        const WalkVariance v =
            measure_variance(walk_scene, 0.1 * tenth, walks, study_rays_per_pixel);
        points.push_back(
            {{"survival", v.survival},
             {"variance", v.variance},
             {"standardError", v.standard_error},
             {"expected", walk_variance(statistics, v.survival, bounces) / study_rays_per_pixel}});
    }
    return {{"figure", name},
            {"raysPerPixel", study_rays_per_pixel},
            {"albedo", statistics.albedo},
            {"meanSquare", statistics.mean_square},
            {"firstVariance", statistics.variance},
            {"expectedOptimum", optimal_survival(statistics, bounces)},
            {"points", points}};
}

}  // namespace

int main() {
    try {
        const nlohmann::ordered_json figures = {
            curve("3.6", constant_scene()),
            curve("3.7, albedo 0.314", lamp_scene(0.1F * glm::pi<float>())),
            curve("3.7, albedo 0.471", lamp_scene(0.15F * glm::pi<float>())),
            curve("3.8", room_scene())};
        std::puts(figures.dump(2).c_str());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
