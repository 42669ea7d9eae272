// SPDX-License-Identifier: Apache-2.0
// `extras.raybundle.air` of a glTF scene:
//   {"visibility": m, or "extinction": 1/m, "albedo": 0..1 or [r, g, b], "anisotropy": -0.9..0.9}
#pragma once

#include <optional>
#include <string>

#include "scene/gltf/file/gltf_json.h"
#include "scene/medium.h"

namespace raybundle {

/// Of the file's default scene; nothing where it has none. In metres, whatever the file's unit.
/// Throws SceneError.
std::optional<Medium> read_air(const std::string& file, const Json& json);

}  // namespace raybundle
