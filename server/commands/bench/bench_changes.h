// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "app/load_scene.h"

namespace raybundle {

/// Time from a change to the corrected frame of a resting picture of 640x400, as `serve` works it
/// in on two cores: a movable object (a door, where there is one), and a lamp that is dimmed. Wall
/// and processor time, milliseconds, and the shares of GL work; printed, and returned as JSON. What
/// the scene lacks is null.
nlohmann::ordered_json bench_changes(const LoadedScene& loaded, std::uint64_t seed);

}  // namespace raybundle
