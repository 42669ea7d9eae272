// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "session/changes/change_log.h"
#include "session/changes/change_queue.h"
#include "session/changes/lighting_scenes.h"

namespace raybundle {

/// The changes that a request stands for, or why it stands for none.
struct Expansion {
    std::vector<v1::SceneChanged> changes;
    v1::Error problem;  ///< unset where there is none
};

/// Of an undo, a group of lights or a lighting scene, as the scene is now.
Expansion expand(const PendingChange& pending, const Scene& scene, const ChangeLog& log,
                 const LightingScenes& lighting);

}  // namespace raybundle
