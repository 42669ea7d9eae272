// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scene/material/reflectance_grid.h"
#include "scene/mesh/edge_refinement.h"
#include "scene/mesh/patch_colour.h"

namespace raybundle {

/// Colours of patches; those of materials without textures are computed once.
class PatchPainter {
  public:
    explicit PatchPainter(const Scene& scene)
        : scene_(scene),
          constant_(scene.materials.size()),
          clamped_(scene.materials.size(), false) {}

    /// Of a triangle with these corners.
    PatchColour colour_of(std::uint32_t number,
                          const std::array<EdgeRefinement::Shading, 3>& corners) {
        const Material& material = scene_.materials[number];
        const std::array<glm::vec2, 3> uv = {corners[0].uv, corners[1].uv, corners[2].uv};
        const glm::vec3 factor = (corners[0].colour + corners[1].colour + corners[2].colour) / 3.0F;
        if (varies_by_texture(material) || factor != glm::vec3(1.0F)) {
            const PatchColour colour = patch_colour(scene_, material, uv, factor);
            clamped_[number] = clamped_[number] || colour.was_clamped;
            return colour;
        }
        std::optional<PatchColour>& known = constant_[number];
        if (!known) {
            known = patch_colour(scene_, material, uv);
            clamped_[number] = known->was_clamped;
        }
        return *known;
    }

    /// Names the materials whose albedo was cut down, if any.
    [[nodiscard]] std::optional<std::string> clamp_notice() const {
        std::string names;
        std::size_t count = 0;
        for (std::size_t m = 0; m < clamped_.size(); ++m) {
            if (clamped_[m] && ++count <= most_named) {
                names += fmt::format("{}\"{}\"", count > 1 ? ", " : "", scene_.materials[m].name);
            }
        }
        if (count == 0) {
            return std::nullopt;
        }
        if (count > most_named) {
            names += fmt::format(" and {} more", count - most_named);
        }
        return fmt::format("albedo clamped to 0.999 for {} {}",
                           count > 1 ? "materials" : "material", names);
    }

  private:
    static constexpr std::size_t most_named = 8;
    const Scene& scene_;
    std::vector<std::optional<PatchColour>> constant_;
    std::vector<bool> clamped_;
};

}  // namespace raybundle
