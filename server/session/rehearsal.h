// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

#include "session/live_scene.h"

namespace raybundle {

/// Sends small pictures through all that a viewer's go through, and rehearses a move: software
/// drivers compile shaders when they are first used, each for some tenths of a second. The
/// iterations count as any others. Takes long; ends early when `stop` is set. Throws GpuError.
void rehearse_pictures(LiveScene& live, const std::atomic<bool>& stop);

}  // namespace raybundle
