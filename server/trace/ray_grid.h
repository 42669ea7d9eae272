// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace raybundle {

/// The rays of a rectangle of pixels: origin and direction change evenly from pixel to pixel, as
/// those of a face of a hemicube, of a picture and of a window do. Metres.
struct RayGrid {
    glm::vec3 origin{0.0F}, origin_x{0.0F},
        origin_y{0.0F};  ///< of pixel (0, 0); per column; per row
    glm::vec3 direction{0.0F}, direction_x{0.0F}, direction_y{0.0F};
    float near = 0.0F;  ///< of the way that counts, in lengths of a ray's direction
    float far = std::numeric_limits<float>::infinity();
    glm::ivec2 first{0}, last{0};   ///< pixels [first, last) are traced
    std::size_t result = 0;         ///< place of pixel (0, 0) in what is traced
    std::size_t result_row = 0;     ///< from row to row
    std::size_t result_column = 1;  ///< from column to column
    int line_row = 0;               ///< row of pixel (0, 0) among the lines of the bundle

    [[nodiscard]] bool empty() const { return last.x <= first.x || last.y <= first.y; }
};

/// What glass is to rays (scene/specular_surface.h).
enum class GlassRule {
    absorbs,  ///< passes, but for single lines, by chance: as bundles see it
    clear,    ///< passes
    shown     ///< a surface like others
};

/// What rays meet, and how.
struct TraceRules {
    unsigned place = 0;  ///< of the objects: 0 now, 1 before
    GlassRule glass = GlassRule::absorbs;
    std::uint32_t bundle = 0;  ///< random number of the bundle, for what absorbs by chance
    /// Side 0 of a surface is the one that the rays leave it from, as windows number it; else the
    /// one that they meet.
    bool sides_along_rays = false;
    /// Fronts win over backs that coincide with them to so much, m; 0: never.
    float tie = 0.0F;
};

}  // namespace raybundle
