// SPDX-License-Identifier: Apache-2.0
#include "reference/emitter_pixels.h"

#include <tbb/parallel_for.h>

#include <cstdint>

namespace raybundle {
namespace {

constexpr int rays_per_side = 8;

}  // namespace

bool pixel_sees_emitter(const RayScene& scene, const CameraRays& camera, std::size_t pixel) {
    const glm::dvec2 corner = camera.corner(pixel);
    for (int k = 0; k < rays_per_side * rays_per_side; ++k) {
        const glm::dvec2 cell(k % rays_per_side, k / rays_per_side);
        const auto hit = scene.trace(
            camera.origin(), camera.direction(corner + (cell + 0.5) / double{rays_per_side}));
        if (hit && scene.emission(*hit) != glm::dvec3(0.0)) {
            return true;
        }
    }
    return false;
}

std::vector<bool> pixels_that_see_emitters(const RayScene& scene, const CameraRays& camera) {
    const std::size_t width = camera.size().x;
    const std::size_t height = camera.size().y;
    std::vector<std::uint8_t> found(width * height, 0);  // bits of vector<bool> share bytes
    tbb::parallel_for(std::size_t{0}, height, [&](std::size_t y) {
        for (std::size_t x = 0; x < width; ++x) {
            found[y * width + x] = pixel_sees_emitter(scene, camera, y * width + x) ? 1 : 0;
        }
    });
    return {found.begin(), found.end()};
}

}  // namespace raybundle
