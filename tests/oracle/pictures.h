// SPDX-License-Identifier: Apache-2.0
// Small pictures of the solver against path tracing.
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "reference/camera_rays.h"
#include "reference/path_reuse.h"
#include "reference/solution_picture.h"

namespace raybundle {

/// Path tracing through the centres of pixels, where the solver looks too; -1 where they show the
/// sky. Neighbouring pixels share their paths.
inline std::vector<glm::dvec3> path_traced_centres(const Scene& scene, const PatchMesh& mesh,
                                                   const Camera& view, glm::uvec2 size,
                                                   std::uint32_t paths) {
    const RayScene rays(scene, mesh);
    const LightSampling lights(rays);
    const PathReuse tracer(rays, lights);
    const CameraRays camera(rays, view, size);
    ImageEstimate image(size, 1, PixelFilter::centre);
    for (std::uint32_t i = 0; i < paths; ++i) {
        tracer.add_pass(image, camera);
    }
    std::vector<glm::dvec3> picture = image.means();
    const auto centres = pixel_centres(rays, camera);
    for (std::size_t i = 0; i < picture.size(); ++i) {
        picture[i] = centres[i] ? picture[i] : glm::dvec3(-1.0);
    }
    return picture;
}

/// Relative RMS difference of the means over blocks of pixels, of two pictures where the second is
/// not negative: the noise of single pixels, and edges that run through the centres of some, are
/// not what is measured.
inline double block_difference(const std::vector<glm::vec4>& picture,
                               const std::vector<glm::dvec3>& truth, glm::uvec2 size,
                               unsigned block) {
    double square = 0.0;
    double total = 0.0;
    for (unsigned y = 0; y + block <= size.y; y += block) {
        for (unsigned x = 0; x + block <= size.x; x += block) {
            glm::dvec3 found(0.0);
            glm::dvec3 exact(0.0);
            for (unsigned k = 0; k < block * block; ++k) {
                const std::size_t pixel = std::size_t{y + k / block} * size.x + x + k % block;
                if (truth[pixel].r >= 0.0) {
                    found += glm::dvec3(picture[pixel]);
                    exact += truth[pixel];
                }
            }
            square += glm::dot(found - exact, found - exact);
            total += glm::dot(exact, exact);
        }
    }
    return std::sqrt(square / total);
}

}  // namespace raybundle
