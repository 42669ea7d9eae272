// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/load_scene.h"
#include "options/cli_options.h"
#include "view/image/whole_file.h"

namespace raybundle {

// Each runs one subcommand and returns its exit status.
int run_serve(const Options& options);
int run_work(const Options& options);
int run_projects(const Options& options);
int run_render(const Options& options);
/// The part of run_render() that needs no GL context.
int run_render_reference(ReferenceKind kind, glm::uvec2 size, const Options& options);
/// The part of run_render() that follows a script.
int run_render_script(const StrategyProbabilities& probabilities, glm::uvec2 size,
                      const Options& options);
/// The part of run_render() that shows the light of patches alone.
int run_render_patches(const StrategyProbabilities& probabilities, glm::uvec2 size,
                       const Options& options);
int run_export(const Options& options);
int run_save(const Options& options);
int run_accuracy(const Options& options);
int run_inspect(const Options& options);
int run_bench(const Options& options);
int run_measure(const Options& options);
int run_selftest(const Options& options);
int run_token(const Options& options);

}  // namespace raybundle
