// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "scene/material/reflectance_table.h"
#include "scene/scene.h"

namespace raybundle {

/// Whether metalness and roughness of a material come from a texture.
bool has_reflectance_grid(const Material& material);

/// Values of metalness and roughness that stand for all that a material's texture takes: the GPU
/// has a BRDF for each, and pixels and patches take the nearest. Roughness goes in equal ratios
/// over the texture's own range, so that lobes are wrong in width by the same small share
/// everywhere; metalness, which is 0 or 1 nearly everywhere, in a few steps.
struct ReflectanceGrid {
    static constexpr int most_roughness_levels = 64;
    static constexpr int most_metallic_levels = 4;

    /// The material must have such a texture.
    ReflectanceGrid(const Scene& scene, const Material& material);

    int roughness_levels = 1;  ///< 1 where the texture's roughness is the same everywhere
    int metallic_levels = 1;
    glm::vec2 low{0.0F}, high{0.0F};  ///< metalness, roughness

    [[nodiscard]] std::size_t size() const {
        return static_cast<std::size_t>(roughness_levels) *
               static_cast<std::size_t>(metallic_levels);
    }
    /// Roughness varies slowest.
    [[nodiscard]] std::size_t nearest(const glm::vec2& metallic_roughness) const;
    [[nodiscard]] glm::vec2 at(std::size_t index) const;
    [[nodiscard]] std::size_t roughness_level(std::size_t index) const {
        return index / static_cast<std::size_t>(metallic_levels);
    }
    /// ln of the lowest roughness, levels per unit of ln, lowest metalness, levels per unit.
    [[nodiscard]] glm::vec4 parameters() const;
};

/// A table for each level of roughness, at the middle metalness. Importance is integrated at a few
/// levels alone, about 6 ms each: it only has to be positive and of the right size.
std::vector<ReflectanceTable> grid_tables(const ReflectanceGrid& grid, const Scene& scene,
                                          const Material& material);

}  // namespace raybundle
