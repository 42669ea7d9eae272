// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace raybundle {

/// The rays of a rectangle of pixels, of a hemicube's face, a picture or a window: origin and
/// direction change linearly from pixel to pixel. Metres.
struct RayGrid {
    glm::vec3 origin{0.0F}, origin_x{0.0F},
        origin_y{0.0F};  ///< of pixel (0, 0); per column; per row
    glm::vec3 direction{0.0F}, direction_x{0.0F}, direction_y{0.0F};
    float near = 0.0F;  ///< start of the ray, in lengths of its direction
    float far = std::numeric_limits<float>::infinity();
    glm::ivec2 first{0}, last{0};   ///< pixels [first, last) are traced
    std::size_t result = 0;         ///< index of pixel (0, 0) in the result
    std::size_t result_row = 0;     ///< from row to row
    std::size_t result_column = 1;  ///< from column to column
    int line_row = 0;               ///< row of pixel (0, 0) among the lines of the bundle

    [[nodiscard]] bool empty() const { return last.x <= first.x || last.y <= first.y; }
};

/// How rays treat glass (scene/material/specular_surface.h).
enum class GlassRule {
    absorbs,  ///< lets a random share of the lines pass, as for bundles
    clear,    ///< lets all lines pass
    shown     ///< a surface like others
};

/// Which surfaces rays meet, and from which side.
struct TraceRules {
    unsigned place = 0;  ///< of the objects: 0 now, 1 before
    GlassRule glass = GlassRule::absorbs;
    std::uint32_t bundle = 0;  ///< random number of the bundle, for what absorbs by chance
    /// Side 0 of a surface is the one that the rays leave it from, as windows number it; else the
    /// one that they meet.
    bool sides_along_rays = false;
    /// A front wins over a back that is nearer by this at most, m; 0: never.
    float tie = 0.0F;
};

}  // namespace raybundle
