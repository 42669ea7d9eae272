// SPDX-License-Identifier: Apache-2.0
#include "session/changes/change_records.h"

#include <algorithm>
#include <iterator>

#include "session/messages/addition_messages.h"

namespace raybundle {

namespace {

bool goes_on(const v1::SceneChanged& change) {
    return change.move_object().has_final() && !change.move_object().final();
}

/// Whether an animation has made both since it was started or wound.
bool same_run(const v1::SceneChanged& last, const v1::SceneChanged& next) {
    return last.has_animation() && next.has_animation() &&
           last.animation().animation() == next.animation().animation() &&
           last.animation().first_epoch() == next.animation().first_epoch();
}

/// Whether both are of a slider, or of a colour being picked, that somebody holds.
bool in_hand(const v1::SceneChanged& last, const v1::SceneChanged& next) {
    constexpr double pause_ms = 2000.0;  // as protocol/raybundle.proto states it
    return !next.has_move_object() && next.at_ms() - last.at_ms() < pause_ms;
}

void take_before(const v1::SceneChanged& from, v1::SceneChanged& to) {
    switch (from.before_case()) {
        case v1::SceneChanged::kObjectBefore:
            *to.mutable_object_before() = from.object_before();
            return;
        case v1::SceneChanged::kLightBefore:
            *to.mutable_light_before() = from.light_before();
            return;
        case v1::SceneChanged::kMaterialBefore:
            *to.mutable_material_before() = from.material_before();
            return;
        case v1::SceneChanged::kDaylightBefore:
            *to.mutable_daylight_before() = from.daylight_before();
            return;
        case v1::SceneChanged::BEFORE_NOT_SET:
            to.clear_before();
            return;
    }
}

}  // namespace

void ChangeRecords::add(v1::SceneChanged change) {
    const auto same = [&change](const v1::SceneChanged& record) {
        return subject_of(record) == subject_of(change);
    };
    const auto last = std::find_if(records_.rbegin(), records_.rend(), same);
    const bool by_hand = last != records_.rend() && last->by() == change.by() &&
                         !last->has_animation() && !change.has_animation() &&
                         (goes_on(*last) || (last == records_.rbegin() && in_hand(*last, change)));
    if (last != records_.rend() && (same_run(*last, change) || by_hand)) {
        change.set_first_epoch(last->has_first_epoch() ? last->first_epoch() : last->epoch());
        take_before(*last, change);
        records_.erase(std::next(last).base());
    }
    if (change.has_animation() && change.animation().first_epoch() < change.epoch()) {
        change.set_first_epoch(change.animation().first_epoch());
    }
    records_.push_back(std::move(change));
    if (records_.size() > max_records) {
        records_.pop_front();
    }
}

void ChangeRecords::tell_beginning(v1::SceneChanged& newest) const {
    if ((!newest.has_move_object() && !newest.has_animation()) || goes_on(newest) ||
        records_.empty()) {
        return;
    }
    const v1::SceneChanged& record = records_.back();
    take_before(record, newest);
    if (record.has_first_epoch()) {
        newest.set_first_epoch(record.first_epoch());
    }
}

void ChangeRecords::fill(v1::ChangeHistory* message) const {
    for (const v1::SceneChanged& record : records_) {
        v1::SceneChanged* const out = message->add_changes();
        *out = record;
        if (out->has_move_object()) {
            out->mutable_move_object()->clear_final();
        }
        name_removal(*out);
    }
}

void set_before(const v1::SceneChanged& before, v1::SceneChanged& change) {
    if (before.has_move_object()) {
        *change.mutable_object_before() = before.move_object();
        change.mutable_object_before()->clear_final();
    } else if (before.has_set_daylight()) {
        *change.mutable_daylight_before() = before.set_daylight();
    } else if (before.has_set_light()) {
        *change.mutable_light_before() = before.set_light();
    } else if (before.has_set_material()) {
        *change.mutable_material_before() = before.set_material();
    }
}

}  // namespace raybundle
