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
        case v1::SceneChanged::kSetDaylight:
            return {kind, 0};
        case v1::SceneChanged::kAddObject:
            return {kind, change.add_object().object()};
        case v1::SceneChanged::kRemoveObject:
            return {v1::SceneChanged::kAddObject, change.remove_object().object()};
        case v1::SceneChanged::kAddLuminaire:
            return {kind, change.add_luminaire().light()};
        case v1::SceneChanged::kRemoveLight:
            return {v1::SceneChanged::kAddLuminaire, change.remove_light().light()};
        case v1::SceneChanged::CHANGE_NOT_SET:
            break;
    }
    return {kind, 0};
}

bool sets_light(const v1::SetLight& set) {
    return set.has_intensity() || set.has_flux() || set.has_colour() ||
           set.has_colour_temperature() || set.has_on() || set.has_dim() || set.has_photometry();
}

namespace {

/// Removes what a newer change replaces: one of two ways to say the same, and vectors, of which
/// merging would keep components where the new ones' are 0.
void clear_replaced(const v1::SetLight& newer, v1::SetLight* sum) {
    if (newer.has_intensity() || newer.has_flux()) {
        sum->clear_intensity();
        sum->clear_flux();
    }
    if (newer.has_colour() || newer.has_colour_temperature()) {
        sum->clear_colour();
        sum->clear_colour_temperature();
    }
    if (newer.has_photometry()) {  // comes with its own flux
        sum->clear_intensity();
        sum->clear_flux();
    }
    if (sets_light(newer)) {
        sum->clear_fade_seconds();
    }
    if (newer.has_position()) {
        sum->clear_position();
    }
    if (newer.has_aim()) {
        sum->clear_aim();
    }
}

/// Likewise: angles of the sun and the clock.
void clear_replaced(const v1::SetDaylight& newer, v1::SetDaylight* sum) {
    if (newer.has_sun_elevation() || newer.has_sun_azimuth()) {
        sum->clear_time();
        sum->clear_place();
    }
    if (!newer.time().empty() || newer.has_place()) {
        sum->clear_sun_elevation();
        sum->clear_sun_azimuth();
    }
    if (newer.has_place()) {
        sum->clear_place();
    }
    sum->clear_lights();
}

}  // namespace

void add_change(const v1::SceneChanged& change, v1::SceneChanged& sum) {
    if (change.has_move_object() || change.has_add_object() || change.has_add_luminaire()) {
        sum = change;
        return;
    }
    if (change.has_set_light() && sum.has_set_light()) {
        clear_replaced(change.set_light(), sum.mutable_set_light());
    }
    if (change.has_set_daylight() && sum.has_set_daylight()) {
        clear_replaced(change.set_daylight(), sum.mutable_set_daylight());
    }
    // Likewise.
    if (change.set_material().has_base_colour() && sum.has_set_material()) {
        sum.mutable_set_material()->clear_base_colour();
    }
    sum.MergeFrom(change);
}

}  // namespace raybundle
