// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace raybundle {

/// Hash of everything in a scene's files, and of what else decides how they are read, as 16
/// hexadecimal digits. Equal for equal content, wherever it lies. `how`: the options of reading.
/// Throws SceneError where a file cannot be read.
std::string scene_fingerprint(const std::string& scene_file, const std::string& how);

}  // namespace raybundle
