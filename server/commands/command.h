// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "options/cli_options.h"
#include "scene/patch_mesh.h"
#include "scene/scene.h"
#include "view/whole_file.h"

namespace raybundle {

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

// Each runs one subcommand and returns its exit status.
int run_serve(const Options& options);
int run_render(const Options& options);
/// The part of run_render() that needs no GL context.
int run_render_reference(ReferenceKind kind, glm::uvec2 size, const Options& options);
/// The part of run_render() that follows a script.
int run_render_script(const StrategyProbabilities& probabilities, glm::uvec2 size,
                      const Options& options);
int run_accuracy(const Options& options);
int run_inspect(const Options& options);
int run_bench(const Options& options);
int run_selftest(const Options& options);
int run_token(const Options& options);

}  // namespace raybundle
