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
    /// The change is what was asked for, and answers it; else they are answered apart.
    bool is_answer = false;
    bool fresh = false;      ///< luminaires that nobody has numbered for good
    std::uint32_t made = 0;  ///< of them have been made before, under the request's key
};

/// Of an undo, a group of lights, a lighting scene, what is added, or an exchange of all luminaires
/// of a type, as the scene is now.
Expansion expand(const PendingChange& pending, const Scene& scene, const PatchMesh& mesh,
                 const ChangeLog& log, const LightingScenes& lighting);

}  // namespace raybundle
