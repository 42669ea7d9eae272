// SPDX-License-Identifier: Apache-2.0
#include "session/review/review_board.h"

#include <algorithm>
#include <cmath>

#include "session/messages/scene_messages.h"

namespace raybundle {

namespace {

constexpr float worth_telling = 0.02F;    // difference of relative changes
constexpr float min_illuminance = 1e-3F;  // lx; below, a change is measured against this

/// A pin as the journal holds it: the message, then where it is and the light there, in fields that
/// are the journal's own.
std::string stored(const Pin& pin) {
    v1::JournalPin note;
    *note.mutable_pin() = pin.message;
    note.set_patch(pin.patch);
    note.set_patch_illuminance(pin.patch_illuminance);
    if (pin.place) {
        note.set_object(pin.place->object + 1);
        to_message(pin.place->position, note.mutable_place());
        to_message(pin.place->normal, note.mutable_normal());
    }
    return note.SerializeAsString();
}

}  // namespace

ReviewBoard::ReviewBoard(ChangeLog& log) : log_(log) {
    for (const std::string& body : log.notes(NoteKind::pin)) {
        add_stored_pin(body);
    }
    for (const std::string& body : log.notes(NoteKind::viewpoint)) {
        v1::ViewpointChanged viewpoint;
        if (viewpoint.ParseFromString(body)) {
            viewpoints_[viewpoint.viewpoint()] = viewpoint;
        }
    }
    next_pin_number_ = pins_.empty() ? 1 : pins_.rbegin()->first + 1;
    next_viewpoint_number_ = viewpoints_.empty() ? 1 : viewpoints_.rbegin()->first + 1;
}

void ReviewBoard::add_stored_pin(const std::string& body) {
    v1::JournalPin note;
    if (note.ParseFromString(body)) {
        Pin& pin = pins_[note.pin().pin()] = {};
        pin.message = note.pin();
        pin.patch = note.patch();
        pin.patch_illuminance = note.patch_illuminance();
        if (note.object() > 0) {
            pin.place = {note.object() - 1, from_message(note.place()),
                         from_message(note.normal())};
        }
    }
}

v1::ServerMessage ReviewBoard::follow(NoteKind kind, std::uint32_t number,
                                      const std::string& body) {
    v1::ServerMessage news;
    if (kind == NoteKind::pin) {
        const auto known = pins_.find(number);
        if (!body.empty()) {
            add_stored_pin(body);
            next_pin_number_ = std::max(next_pin_number_, number + 1);
            *news.mutable_pin_changed() = pins_[number].message;
        } else if (known != pins_.end()) {
            *news.mutable_pin_changed() = known->second.message;
            news.mutable_pin_changed()->set_removed(true);
            pins_.erase(known);
        }
        if (news.has_pin_changed()) {
            news.mutable_pin_changed()->set_by(0);  // viewers' numbers are each server's own
        }
        return news;
    }
    v1::ViewpointChanged viewpoint;
    if (body.empty() && viewpoints_.erase(number) > 0) {
        news.mutable_viewpoint_changed()->set_viewpoint(number);
        news.mutable_viewpoint_changed()->set_removed(true);
    } else if (!body.empty() && viewpoint.ParseFromString(body)) {
        viewpoint.set_by(0);
        next_viewpoint_number_ = std::max(next_viewpoint_number_, number + 1);
        *news.mutable_viewpoint_changed() = viewpoints_[number] = viewpoint;
    }
    return news;
}

bool ReviewBoard::refuse_unsaved(const std::string& reason) {
    refusal_ = log_.refusal(reason);
    return false;
}

bool ReviewBoard::refuse(v1::Error::Code code, const std::string& reason) {
    refusal_.set_code(code);
    refusal_.set_message(reason);
    return false;
}

const Pin* ReviewBoard::add_pin(Pin pin, const std::string& key) {
    if (pins_.size() >= max_pins) {
        refuse(v1::Error::RESOURCE_EXHAUSTED, "addPin: there are 256 pins, remove some");
        return nullptr;
    }
    const auto number = log_.new_number(NoteKind::pin, next_pin_number_);
    pin.message.set_pin(number.value_or(0));
    if (!number || !log_.keep_note(NoteKind::pin, *number, stored(pin), key)) {
        refuse_unsaved("the pin could not be saved, so it was not set");
        return nullptr;
    }
    next_pin_number_ = *number + 1;
    return &(pins_[*number] = std::move(pin));
}

const v1::ViewpointChanged* ReviewBoard::add_viewpoint(v1::ViewpointChanged viewpoint,
                                                       const std::string& key) {
    if (viewpoints_.size() >= max_viewpoints) {
        refuse(v1::Error::RESOURCE_EXHAUSTED, "saveViewpoint: there are 64, remove some");
        return nullptr;
    }
    const auto number = log_.new_number(NoteKind::viewpoint, next_viewpoint_number_);
    viewpoint.set_viewpoint(number.value_or(0));
    if (!number ||
        !log_.keep_note(NoteKind::viewpoint, *number, viewpoint.SerializeAsString(), key)) {
        refuse_unsaved("the viewpoint could not be saved");
        return nullptr;
    }
    next_viewpoint_number_ = *number + 1;
    return &(viewpoints_[*number] = std::move(viewpoint));
}

v1::ServerMessage ReviewBoard::answer_of(const KeyedNote& kept) const {
    v1::ServerMessage answer;
    if (kept.kind == NoteKind::pin) {
        const auto pin = pins_.find(kept.number);
        v1::PinChanged& changed = *answer.mutable_pin_changed();
        changed = pin == pins_.end() ? v1::PinChanged() : pin->second.message;
        changed.set_pin(kept.number);
        changed.set_removed(pin == pins_.end());
    } else if (kept.kind == NoteKind::viewpoint) {
        const auto viewpoint = viewpoints_.find(kept.number);
        v1::ViewpointChanged& changed = *answer.mutable_viewpoint_changed();
        changed = viewpoint == viewpoints_.end() ? v1::ViewpointChanged() : viewpoint->second;
        changed.set_viewpoint(kept.number);
        changed.set_removed(viewpoint == viewpoints_.end());
    }
    return answer;
}

bool ReviewBoard::remove_pin(std::uint32_t number) {
    if (!pins_.contains(number)) {
        return refuse(v1::Error::NOT_FOUND, "removePin.pin: no pin " + std::to_string(number));
    }
    if (!log_.keep_note(NoteKind::pin, number, {})) {
        return refuse_unsaved("the pin's removal could not be saved");
    }
    pins_.erase(number);
    return true;
}

const Pin* ReviewBoard::change_pin(std::uint32_t number, const std::string& what,
                                   const std::function<std::string(v1::PinChanged&)>& change,
                                   const std::string& key) {
    const auto found = pins_.find(number);
    if (found == pins_.end()) {
        refuse(v1::Error::NOT_FOUND, what + ".pin: no pin " + std::to_string(number));
        return nullptr;
    }
    Pin changed = found->second;
    if (const std::string problem = change(changed.message); !problem.empty()) {
        refuse(v1::Error::RESOURCE_EXHAUSTED, what + ": " + problem);
        return nullptr;
    }
    if (!log_.keep_note(NoteKind::pin, number, stored(changed), key)) {
        refuse_unsaved("the pin could not be saved");
        return nullptr;
    }
    found->second = std::move(changed);
    return &found->second;
}

bool ReviewBoard::remove_viewpoint(std::uint32_t number) {
    if (!viewpoints_.contains(number)) {
        return refuse(v1::Error::NOT_FOUND,
                      "removeViewpoint.viewpoint: no viewpoint " + std::to_string(number));
    }
    if (!log_.keep_note(NoteKind::viewpoint, number, {})) {
        return refuse_unsaved("the viewpoint's removal could not be saved");
    }
    viewpoints_.erase(number);
    return true;
}

void ReviewBoard::keep(const Pin& pin) {
    static_cast<void>(log_.keep_note(NoteKind::pin, pin.message.pin(), stored(pin)));
}

Pin* ReviewBoard::next_pin() {
    if (pins_.empty()) {
        return nullptr;
    }
    auto next = pins_.upper_bound(last_checked_);
    next = next == pins_.end() ? pins_.begin() : next;
    last_checked_ = next->first;
    return &next->second;
}

void ReviewBoard::fill_welcome(v1::Welcome* welcome) const {
    for (const auto& [number, pin] : pins_) {
        *welcome->add_pins() = pin.message;
    }
    for (const auto& [number, viewpoint] : viewpoints_) {
        *welcome->add_viewpoints() = viewpoint;
    }
}

bool update_change(Pin& pin, float illuminance, std::uint32_t epoch) {
    if (epoch <= pin.message.epoch()) {
        pin.patch_illuminance = illuminance;
        return false;
    }
    const float before = std::max(pin.patch_illuminance, min_illuminance);
    const float change = (illuminance - pin.patch_illuminance) / before;
    if (pin.message.has_change() && std::abs(change - pin.message.change()) < worth_telling) {
        return false;
    }
    pin.message.set_change(change);
    return true;
}

}  // namespace raybundle
