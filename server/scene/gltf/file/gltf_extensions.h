// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "scene/gltf/file/gltf_document.h"
#include "scene/gltf/file/gltf_json.h"

namespace raybundle {

/// Throws SceneError naming the first entry of extensionsRequired that cannot be honoured.
void check_required_extensions(const std::string& file, const Json& json);

/// Adds a notice for every used extension that is ignored or only approximated, for animations,
/// and for other features that are read in a simplified way.
void note_ignored_extensions(const Json& json, GltfDocument& document);

}  // namespace raybundle
