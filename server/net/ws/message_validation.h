// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "net/ws/wire_codec.h"

namespace raybundle {

/// Checks every range that raybundle.proto states and that can be checked without a scene: finite
/// numbers, field of view, sizes, directions, rotations, colours. Returns the first violation.
/// Whether an object, light, material, viewer or pixel exists is for the render thread to say.
std::optional<Refusal> validate(const v1::ClientMessage& message, const WireLimits& limits);

}  // namespace raybundle
