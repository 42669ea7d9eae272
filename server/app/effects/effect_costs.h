// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>

#include "options/cli_options.h"
#include "scene/effects/effects_plan.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// Fills in what each active effect costs, ms per iteration on this machine: the difference between
/// an iteration of the scene and one of the scene without the effect; of `diffuse`, an iteration
/// of the scene without any other. Some seconds; on a GL context of its own, and less where it is
/// told to stop. Throws GpuError where there is no usable device.
void measure_effects(const Options& options, const Scene& scene, const PatchMesh& mesh,
                     EffectsPlan& plan, const std::stop_token& stop = {});

}  // namespace raybundle
