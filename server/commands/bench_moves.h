// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "commands/command.h"

namespace raybundle {

/// Moves the first movable object of a scene and measures the picture's error against a converged
/// fresh solve over the time since the move: special phases of 1, 3, 10 and 30 bundles, each with
/// and without scissoring, none at all, and a restart from scratch. Prints what it finds; svg: file
/// to draw it into, or empty. Null where nothing can be moved.
nlohmann::ordered_json bench_moves(const LoadedScene& loaded, std::uint64_t seed,
                                   const std::string& svg);

}  // namespace raybundle
