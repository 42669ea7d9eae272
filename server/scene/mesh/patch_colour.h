// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "scene/scene.h"

namespace raybundle {

/// Area means over one patch.
struct PatchColour {
    glm::vec3 base_colour{0.0F};         ///< clamped_base_colour() of the covered part
    glm::vec3 emission{0.0F};            ///< radiance, cd/m²
    glm::vec2 metallic_roughness{0.0F};  ///< factors times texture
    float coverage = 1.0F;               ///< share that alpha MASK leaves, 0: nothing is there
    bool was_clamped = false;            ///< the base colour
};

/// Alpha of the base colour texture below which nothing is there: glTF compares factor * texture
/// with alphaCutoff. None without alpha MASK.
std::optional<float> texture_alpha_cutoff(const Material& material);

/// Colours of a patch with this material and these mesh uv at its corners; factor: mean of the
/// vertex colours. An unlit material is black: it is shown, but takes no part in the light.
PatchColour patch_colour(const Scene& scene, const Material& material,
                         const std::array<glm::vec2, 3>& mesh_uv,
                         const glm::vec3& factor = glm::vec3(1.0F));

/// Whether patches of a material differ by where they lie on its textures.
bool varies_by_texture(const Material& material);

/// Base colour, linear, of a material as a whole: factor times the mean of the texture.
glm::vec3 mean_base_colour(const Scene& scene, const Material& material);

/// Only the emission, cd/m².
glm::vec3 patch_emission(const Scene& scene, const Material& material,
                         const std::array<glm::vec2, 3>& mesh_uv);

}  // namespace raybundle
