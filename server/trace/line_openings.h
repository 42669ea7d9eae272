// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/material/specular_surface.h"
#include "scene/scene.h"
#include "trace/ray_grid.h"

namespace raybundle {

/// Where rays pass through surfaces: cut-outs (alpha MASK) and glass, by the rules of
/// shaders/material/alpha_mask.glsl and shaders/material/glass.glsl. Keeps copies of the textures
/// and materials that it needs.
class LineOpenings {
  public:
    explicit LineOpenings(const Scene& scene);

    /// Follows a change of a material.
    void update(const Scene& scene, std::size_t material);
    /// Whether rays may pass some surface of a material.
    [[nodiscard]] bool may_pass(std::size_t material) const {
        return materials_[material].cutoff > 0.0F || materials_[material].is_glass;
    }
    /// Whether alpha cuts out a point of the mesh.
    [[nodiscard]] bool cut_out(std::size_t material, const glm::vec2& mesh_uv) const;
    /// Whether a line passes glass of a material. cosine: to its normal, 0..1; line: any number of
    /// its own.
    [[nodiscard]] bool passes(std::size_t material, std::uint32_t facet, float cosine,
                              const TraceRules& rules, std::uint32_t line) const;

  private:
    struct Surface {
        float cutoff = 0.0F;  ///< of alpha; 0: nothing is cut out
        std::size_t alpha = 0;
        glm::mat3 uv_from_mesh_uv{1.0F};
        bool is_glass = false;
        BundleGlass glass;
    };
    struct Alpha {
        int width = 0, height = 0;
        bool repeat_u = true, repeat_v = true;
        std::vector<std::uint8_t> values;
    };
    std::vector<Surface> materials_;
    std::vector<Alpha> alphas_;  ///< of the scene's textures; empty where no material cuts by it
};

}  // namespace raybundle
