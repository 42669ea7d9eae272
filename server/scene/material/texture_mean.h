// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "scene/scene.h"

namespace raybundle {

/// Linear value of an sRGB-encoded byte (IEC 61966-2-1), 0..1.
float linear_from_srgb(std::uint8_t encoded);

struct TextureMean {
    glm::vec3 colour{0.0F};  ///< linear, over the covered part
    float coverage = 1.0F;   ///< share of the triangle whose alpha reaches the cutoff
};

/// Area mean of a colour texture, in linear light, over a triangle given by its mesh uv. With
/// `alpha_cutoff`, texels whose alpha is below it do not count.
TextureMean texture_mean(const Texture& texture, const glm::mat3& uv_from_mesh_uv,
                         const std::array<glm::vec2, 3>& mesh_uv,
                         std::optional<float> alpha_cutoff = std::nullopt);

/// Area mean of a texture that holds numbers and no colours, 0..1.
glm::vec3 texture_data_mean(const Texture& texture, const glm::mat3& uv_from_mesh_uv,
                            const std::array<glm::vec2, 3>& mesh_uv);

}  // namespace raybundle
