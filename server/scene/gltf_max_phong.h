// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "scene/gltf_document.h"
#include "scene/scene.h"

namespace raybundle {

/// `extras.raybundle.maxPhong` of a material: {"specular": [r, g, b], "exponent": n}, specular
/// 0..1, exponent 1..1000, both required. Nothing where the material has none; extras of other
/// programs, of whatever type, are left alone. Throws SceneError naming the member under `path`.
std::optional<MaxPhong> read_max_phong(const GltfDocument& document, const Json& material,
                                       const std::string& path);

}  // namespace raybundle
