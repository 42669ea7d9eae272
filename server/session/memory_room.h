// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <istream>
#include <optional>

namespace raybundle {

/// Memory of this machine that a program may still take, bytes: what Linux estimates, or what the
/// limit of the control group leaves where that is less. Nothing where neither is known.
std::optional<double> available_memory();

/// MemAvailable of a text as /proc/meminfo, bytes.
std::optional<double> memory_available_in(std::istream& meminfo);

/// The largest size of the same shape, `wanted` at most, whose pixels fit; nothing where fewer than
/// 64 x 64 do.
std::optional<glm::uvec2> size_within_memory(glm::uvec2 wanted, double bytes_per_pixel,
                                             double available);

}  // namespace raybundle
