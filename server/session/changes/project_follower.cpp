// SPDX-License-Identifier: Apache-2.0
#include "session/changes/project_follower.h"

#include <utility>

namespace raybundle {

void ProjectFollower::step() {
    for (LogEntry& entry : parts_.scene.log().take_entries()) {
        if (entry.change.epoch() > 0) {
            parts_.changes.follow(std::move(entry));
            continue;
        }
        switch (entry.kind) {
            case NoteKind::pin:
            case NoteKind::viewpoint:
                parts_.review.follow(entry);
                break;
            case NoteKind::target:
                parts_.views.follow(entry);
                break;
            case NoteKind::lighting_scene:
                parts_.lighting.follow(entry);
                break;
            case NoteKind::played:  // its changes come as such
                break;
            case NoteKind::zone:
            case NoteKind::requirements:
                parts_.measurements.follow(entry);
                break;
        }
    }
}

}  // namespace raybundle
