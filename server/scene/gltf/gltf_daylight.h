// SPDX-License-Identifier: Apache-2.0
// `extras.raybundle.daylight` of a glTF scene:
//   {"sky": "clear", "zenithLuminance": cd/m², "sunElevation": degrees, "sunAzimuth": degrees,
//    "sunIlluminance": lx, "sunDiameter": degrees, "groundAlbedo": 0..1}, or
//   {"environment": "file.hdr", "environmentRotation": degrees, "environmentScale": cd/m²}.
#pragma once

#include <string>

#include "scene/gltf/file/gltf_json.h"
#include "scene/light/daylight.h"

namespace raybundle {

/// Of the file's default scene; nothing given where it has none. Throws SceneError.
Daylight read_daylight(const std::string& file, const Json& json);

}  // namespace raybundle
