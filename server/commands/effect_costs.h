// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "cli_options.h"
#include "commands/command.h"
#include "scene/effects_plan.h"

namespace raybundle {

/// Fills in what each active effect costs, ms per iteration on this machine: the difference between
/// an iteration of the scene and one of the scene without the effect; of `diffuse`, an iteration
/// of the scene without any other. Some seconds. Throws GpuError where there is no usable device.
void measure_effects(const Options& options, const LoadedScene& loaded, EffectsPlan& plan);

}  // namespace raybundle
