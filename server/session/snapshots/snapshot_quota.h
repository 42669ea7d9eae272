// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "net/ws/client_event.h"

namespace raybundle {

/// Whose snapshots wait, and how many of them: a picture takes up to an hour, and one is made at a
/// time.
struct WaitingSnapshot {
    ViewerId viewer = 0;
    v1::Role role = v1::VIEWER;
};

inline constexpr std::size_t max_snapshots = 8;  ///< of all viewers
/// Derived: who compares two lights asks for two.
inline constexpr std::size_t max_snapshots_per_viewer = 2;
/// Derived: who may only look leaves half of the places to those who work.
inline constexpr std::size_t max_snapshots_of_viewers = max_snapshots / 2;
/// Who works may ask for as many as all who only look.
inline constexpr std::size_t max_snapshots_per_editor = max_snapshots_of_viewers;

/// Why another one is not taken, or nothing.
std::optional<std::string> refuse_snapshot(std::span<const WaitingSnapshot> waiting,
                                           const WaitingSnapshot& next);

/// Place among those that wait, the first of which is being made: before the second picture of
/// another viewer comes everybody's first, before the third everybody's second.
std::size_t place_of_snapshot(std::span<const WaitingSnapshot> waiting,
                              const WaitingSnapshot& next);

}  // namespace raybundle
