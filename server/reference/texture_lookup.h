// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "scene/scene.h"

namespace raybundle {

/// Bilinear lookup of a texture at mesh uv: linear colour and, in w, alpha.
glm::dvec4 look_up(const Texture& texture, const glm::mat3& uv_from_mesh_uv,
                   const glm::dvec2& mesh_uv);

/// The same of a texture that holds numbers and no colours: all four as they are.
glm::dvec4 look_up_data(const Texture& texture, const glm::mat3& uv_from_mesh_uv,
                        const glm::dvec2& mesh_uv);

}  // namespace raybundle
