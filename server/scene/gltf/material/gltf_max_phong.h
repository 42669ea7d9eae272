// SPDX-License-Identifier: Apache-2.0
// `extras.raybundle.maxPhong` of a material: {"specular": [r, g, b], "exponent": n}, specular 0..1,
// exponent 1..1000, both required.
#pragma once

#include <optional>
#include <string>

#include "scene/gltf/file/gltf_model.h"
#include "scene/scene.h"

namespace raybundle {

/// Checks it in all materials of JSON that has passed check_schema(), which looks at no extras:
/// those of other programs may be of any type and are left alone. Throws SceneError.
void check_max_phong(const std::string& file, const Json& json);

/// Nothing where a material's extras, which have been checked, have none.
std::optional<MaxPhong> read_max_phong(const tinygltf::Value& extras);

}  // namespace raybundle
