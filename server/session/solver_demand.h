// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "session/live_scene.h"
#include "session/viewers/viewers.h"

namespace raybundle {

/// Says whether anybody wants more iterations.
class SolverDemand {
  public:
    SolverDemand(const LiveScene& scene, const Viewers& viewers, std::uint64_t idle_iterations)
        : scene_(scene), viewers_(viewers), idle_iterations_(idle_iterations) {}

    /// True while everyone who watches has what was asked for. While nobody watches: once there
    /// have been enough iterations since the last change.
    [[nodiscard]] bool nobody_waits() const;

  private:
    const LiveScene& scene_;
    const Viewers& viewers_;
    std::uint64_t idle_iterations_;
};

}  // namespace raybundle
