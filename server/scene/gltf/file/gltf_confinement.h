// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace raybundle {

/// Makes sure that a scene file refers to nothing outside its own folder, through symbolic links
/// either: neither its buffers nor its images, IES files or surroundings. For scenes of people who
/// may not read every file of this machine. Throws SceneError.
void check_confined(const std::string& scene_file);

/// The scene file and the files that it refers to, whether they exist or not. Throws SceneError
/// where it cannot be read or refers to what is no file.
std::vector<std::string> files_of_scene(const std::string& scene_file);

}  // namespace raybundle
