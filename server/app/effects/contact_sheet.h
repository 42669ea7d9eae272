// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "app/load_scene.h"
#include "options/cli_options.h"

namespace raybundle {

/// What an effect costs in a scene, one viewer of contact_size included.
struct EffectCost {
    double ms_with = 0.0, ms_without = 0.0;  ///< per iteration
    std::size_t bytes_with = 0, bytes_without = 0;
};

/// Writes options.inspect.contact_sheet, a PNG: the scene by its first camera with the effect
/// options.inspect.effect at the left, without it at the right, exposed alike. Some seconds. Throws
/// UsageError where the scene does not call for the effect or it cannot be taken out, GpuError,
/// and std::runtime_error where the file cannot be written.
EffectCost write_contact_sheet(const Options& options, const LoadedScene& loaded);

}  // namespace raybundle
