// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "gpu/egl_context.h"
#include "net/ws/wire_codec.h"

namespace raybundle {

/// What a client is told whose picture cannot be made: there is no memory for it, or the driver
/// has refused a command.
Refusal refusal_of(const GpuError& error);

}  // namespace raybundle
