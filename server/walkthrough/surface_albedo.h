// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// How much a surface reflects towards the eye of light from everywhere alike, by the angle:
/// albedo = rgb + a * base colour. What a mirror or a coat reflects is in it, as if its
/// surroundings were as bright as what lights it.
using AlbedoRow = std::array<glm::vec4, 32>;

/// Cosine of an entry: entries are closer together at grazing angles, where the albedo is steep.
constexpr float albedo_cosine(std::size_t entry) {
    const float root = static_cast<float>(entry) / static_cast<float>(AlbedoRow{}.size() - 1);
    return root * root;
}

/// Row of each material; nothing where the albedo is the base colour at every angle. Roughness and
/// metalness of textures are their means over the surface.
std::vector<std::optional<AlbedoRow>> surface_albedos(const Scene& scene, const PatchMesh& mesh);

/// The same of one material.
std::optional<AlbedoRow> surface_albedo(const Scene& scene, const PatchMesh& mesh,
                                        std::size_t material);

/// Share of the light that passes a pane, or one boundary of a body of glass, straight on, at
/// normal incidence; half of what the body's mean chord absorbs counts for each of its boundaries.
/// 0 where a material is no glass.
glm::vec3 transparency(const Scene& scene, std::size_t material);

}  // namespace raybundle
