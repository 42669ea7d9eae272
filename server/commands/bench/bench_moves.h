// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "commands/command.h"

namespace raybundle {

/// Moves the first movable object of a scene and measures the picture's error against a converged
/// fresh solve over the time since the move: special phases of 1, 3, 10 and 30 bundles, none at
/// all, and a restart from scratch. seconds: time to follow each; where it is given, phases
/// without scissoring are measured too, and against a longer reference (minutes instead of one).
/// Prints what it finds; svg: file to draw it into, or empty. Null where nothing can be moved.
nlohmann::ordered_json bench_moves(const LoadedScene& loaded, std::uint64_t seed,
                                   std::optional<double> seconds, const std::string& svg);

}  // namespace raybundle
