// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "bundle/bundle_frame.h"

namespace raybundle {

/// Thickness of the slab that parallel bundles look through, for a scene of the given diameter, m:
/// the R of the densities (ch. 6.3).
constexpr float parallel_depth(float diameter) {
    return 1.001F * diameter;
}

/// Geometry of a parallel bundle's window for one direction: origin at a corner, square pixels,
/// covering the sphere round the scene, shifted by a random share of a pixel. The scene lies
/// between z = 0 and z = depth.
struct ParallelWindow {
    BundleFrame frame;
    int size = 0;              ///< pixels along a side
    float pixel_size = 0.0F;   ///< m
    float depth = 0.0F;        ///< m, along z
    float plane_depth = 0.0F;  ///< m, of the plane that splits the scene, where there is one

    [[nodiscard]] PixelRectangle full() const { return {0, 0, size, size}; }
    /// Pixels whose lines can meet any of the boxes.
    [[nodiscard]] PixelRectangle covering(std::span<const Bounds> boxes) const;
    /// Picture of the window; depth(z) = depth_scale * z + depth_offset in [0, 1].
    [[nodiscard]] glm::mat4 clip_from_world(float depth_scale, float depth_offset) const;
};

/// direction: unit; angle of the window about it, radians; shift in pixels, [0, 1); centre and
/// diameter: of the scene's sphere, m.
ParallelWindow make_parallel_window(int size, const glm::vec3& direction, float angle,
                                    const glm::vec2& shift, const glm::vec3& centre,
                                    float diameter);

}  // namespace raybundle
