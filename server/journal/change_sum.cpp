// SPDX-License-Identifier: Apache-2.0
#include "journal/change_sum.h"

namespace raybundle {

ChangeSubject subject_of(const v1::SceneChanged& change) {
    const int kind = change.change_case();
    switch (change.change_case()) {
        case v1::SceneChanged::kMoveObject:
            return {kind, change.move_object().object()};
        case v1::SceneChanged::kSetLight:
            return {kind, change.set_light().light()};
        case v1::SceneChanged::kSetMaterial:
            return {kind, change.set_material().material()};
        case v1::SceneChanged::CHANGE_NOT_SET:
            break;
    }
    return {kind, 0};
}

void add_change(const v1::SceneChanged& change, v1::SceneChanged& sum) {
    if (change.has_move_object()) {
        sum = change;
        return;
    }
    // Merging would keep components of the old colour where the new one's are 0.
    if (change.set_light().has_colour() && sum.has_set_light()) {
        sum.mutable_set_light()->clear_colour();
    }
    if (change.set_material().has_base_colour() && sum.has_set_material()) {
        sum.mutable_set_material()->clear_base_colour();
    }
    sum.MergeFrom(change);
}

}  // namespace raybundle
