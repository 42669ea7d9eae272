// SPDX-License-Identifier: Apache-2.0
// Changes of materials while a scene is being shown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "scene/edit/light_edit.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// A material as it shall be; what is absent stays.
struct MaterialEdit {
    std::uint32_t material = 0;            ///< index into Scene::materials plus one
    std::optional<glm::vec3> base_colour;  ///< factor of the texture where there is one, linear
    std::optional<float> roughness;        ///< 0..1
    std::optional<float> metallic;         ///< 0..1
};

/// Why an edit cannot be made, e.g. "no material 7"; empty where it can. Numbers are taken to be in
/// range.
std::string problem_of(const Scene& scene, const MaterialEdit& edit);

/// Makes an edit without problem. Returns the index of the material that has changed.
std::uint32_t apply(Scene& scene, const MaterialEdit& edit);

/// Gives the patches of some materials the colours that these have now.
void refresh_surfaces(const Scene& scene, std::span<const std::uint32_t> materials,
                      PatchMesh& mesh);

}  // namespace raybundle
