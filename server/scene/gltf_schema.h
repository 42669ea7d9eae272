// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/gltf_json.h"

namespace raybundle {

/// Checks every member that the loader reads: presence, type, range, and that indices refer to
/// something. What the loader does not read (animations, say) is not looked at. Throws SceneError
/// with the JSON path of the first fault.
void check_schema(const std::string& file, const Json& json);

}  // namespace raybundle
