// SPDX-License-Identifier: Apache-2.0
#include "reference/measures/emitter_pixels.h"

#include <tbb/parallel_for.h>

#include <cstdint>
#include <optional>

#include "reference/measures/image_metrics.h"
#include "reference/solution_picture.h"
#include "reference/specular_walk.h"
#include "scene/light/environment.h"

namespace raybundle {
namespace {

constexpr int rays_per_side = 8;

/// What a camera's ray shows: the first surface that is neither mirror nor glass, a luminaire, or
/// the sky.
SpecularWalk shown(const RayScene& scene, const CameraRays& camera, const glm::dvec2& at) {
    return walk_strongest(scene, camera.origin(), camera.direction(at));
}

}  // namespace

bool pixel_sees_emitter(const RayScene& scene, const CameraRays& camera, std::size_t pixel) {
    const glm::dvec2 corner = camera.corner(pixel);
    if (has_sky(scene.scene()) && !shown(scene, camera, corner + glm::dvec2(0.5)).hit) {
        return true;
    }
    for (int k = 0; k < rays_per_side * rays_per_side; ++k) {
        const glm::dvec2 cell(k % rays_per_side, k / rays_per_side);
        const SpecularWalk walk =
            shown(scene, camera, corner + (cell + 0.5) / double{rays_per_side});
        if (walk.luminaire || (walk.hit && scene.emission(*walk.hit) != glm::dvec3(0.0))) {
            return true;
        }
    }
    return false;
}

bool pixel_is_measured(const RayScene& scene, const CameraRays& camera, glm::uvec2 at) {
    const glm::uvec2 first = glm::max(at, 1U) - 1U;
    const glm::uvec2 last = glm::min(at + 1U, camera.size() - 1U);
    for (unsigned y = first.y; y <= last.y; ++y) {
        for (unsigned x = first.x; x <= last.x; ++x) {
            if (pixel_sees_emitter(scene, camera, std::size_t{y} * camera.size().x + x)) {
                return false;
            }
        }
    }
    return true;
}

std::vector<bool> measured_pixels(const RayScene& scene, const CameraRays& camera) {
    const std::size_t width = camera.size().x;
    const std::size_t height = camera.size().y;
    std::vector<std::uint8_t> found(width * height, 0);  // bits of vector<bool> share bytes
    tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            found[y * width + x] = pixel_sees_emitter(scene, camera, y * width + x) ? 1 : 0;
        }
    });
    return without_emitters({found.begin(), found.end()}, camera.size());
}

std::vector<bool> reflecting_pixels(const RayScene& scene, const CameraRays& camera) {
    std::vector<bool> result;
    for (const auto& hit : pixel_centres(scene, camera)) {
        result.push_back(hit && !hit->absorbs() && scene.emission(*hit) == glm::dvec3(0.0));
    }
    return result;
}

}  // namespace raybundle
