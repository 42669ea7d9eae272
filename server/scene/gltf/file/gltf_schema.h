// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/gltf/file/gltf_json.h"

namespace raybundle {

/// Checks every member that the loader reads: presence, type, range, and that indices refer to
/// something. What the loader does not read (animations, say) is not looked at. Throws SceneError
/// with the JSON path of the first fault. Numbers that pass are written as tinygltf looks for them,
/// indices and other integers as integers (files may say 1.0), all others as doubles: it takes a
/// member that is stored otherwise for absent.
void check_schema(const std::string& file, Json& json);

}  // namespace raybundle
