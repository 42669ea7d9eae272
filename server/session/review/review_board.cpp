// SPDX-License-Identifier: Apache-2.0
#include "session/review/review_board.h"

#include <algorithm>
#include <cmath>

namespace raybundle {

namespace {

constexpr float worth_telling = 0.02F;    // difference of relative changes
constexpr float min_illuminance = 1e-3F;  // lx; below, a change is measured against this

/// A pin as the journal holds it: the message, then the patch's number and illuminance, in fields
/// that are the journal's own.
std::string stored(const Pin& pin) {
    v1::JournalPin note;
    *note.mutable_pin() = pin.message;
    note.set_patch(pin.patch);
    note.set_patch_illuminance(pin.patch_illuminance);
    return note.SerializeAsString();
}

}  // namespace

ReviewBoard::ReviewBoard(ChangeLog& log, std::uint32_t side_count) : log_(log) {
    for (const std::string& body : log.notes(NoteKind::pin)) {
        v1::JournalPin note;
        if (note.ParseFromString(body)) {
            const std::uint32_t patch = std::min(note.patch(), side_count - 1);
            pins_[note.pin().pin()] = {note.pin(), patch, note.patch_illuminance()};
        }
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

bool ReviewBoard::refuse(v1::Error::Code code, const std::string& reason) {
    refusal_.set_code(code);
    refusal_.set_message(reason);
    return false;
}

const Pin* ReviewBoard::add_pin(Pin pin) {
    if (pins_.size() >= max_pins) {
        refuse(v1::Error::RESOURCE_EXHAUSTED, "addPin: there are 256 pins, remove some");
        return nullptr;
    }
    pin.message.set_pin(next_pin_number_);
    if (!log_.keep_note(NoteKind::pin, next_pin_number_, stored(pin))) {
        refuse(v1::Error::INTERNAL, "the pin could not be saved, so it was not set");
        return nullptr;
    }
    return &(pins_[next_pin_number_++] = std::move(pin));
}

const v1::ViewpointChanged* ReviewBoard::add_viewpoint(v1::ViewpointChanged viewpoint) {
    if (viewpoints_.size() >= max_viewpoints) {
        refuse(v1::Error::RESOURCE_EXHAUSTED, "saveViewpoint: there are 64, remove some");
        return nullptr;
    }
    viewpoint.set_viewpoint(next_viewpoint_number_);
    if (!log_.keep_note(NoteKind::viewpoint, next_viewpoint_number_,
                        viewpoint.SerializeAsString())) {
        refuse(v1::Error::INTERNAL, "the viewpoint could not be saved");
        return nullptr;
    }
    return &(viewpoints_[next_viewpoint_number_++] = std::move(viewpoint));
}

bool ReviewBoard::remove_pin(std::uint32_t number) {
    if (!pins_.contains(number)) {
        return refuse(v1::Error::NOT_FOUND, "removePin.pin: no pin " + std::to_string(number));
    }
    if (!log_.keep_note(NoteKind::pin, number, {})) {
        return refuse(v1::Error::INTERNAL, "the pin's removal could not be saved");
    }
    pins_.erase(number);
    return true;
}

bool ReviewBoard::remove_viewpoint(std::uint32_t number) {
    if (!viewpoints_.contains(number)) {
        return refuse(v1::Error::NOT_FOUND,
                      "removeViewpoint.viewpoint: no viewpoint " + std::to_string(number));
    }
    if (!log_.keep_note(NoteKind::viewpoint, number, {})) {
        return refuse(v1::Error::INTERNAL, "the viewpoint's removal could not be saved");
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
