// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "options/cli_options.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// How the options want scenes to be cut into patches.
TessellationSettings tessellation_settings(const Options& options);

/// A scene read and tessellated as the options say, notices and progress in the log. Throws
/// SceneError.
struct LoadedScene {
    Scene scene;
    PatchMesh mesh;
    double seconds = 0.0;  ///< to read and tessellate
    std::string digest;    ///< SHA-256 of the file, hexadecimal
};
LoadedScene load_scene(const Options& options);
/// Calls `accepted` once the file has been checked, before it is cut into patches.
LoadedScene load_scene(const Options& options, const std::function<void()>& accepted);

}  // namespace raybundle
