// SPDX-License-Identifier: Apache-2.0
#include "net/ws/viewer_link.h"

#include <algorithm>
#include <utility>

#include "net/ws/wire_codec.h"

namespace raybundle {
namespace {

constexpr std::string_view kGreeting = "welcome";  ///< payload of the ping after it

std::vector<std::uint8_t> with_headroom(std::string_view payload) {
    std::vector<std::uint8_t> bytes(Outgoing::kHeadroom + payload.size());
    std::copy(payload.begin(), payload.end(), bytes.begin() + Outgoing::kHeadroom);
    return bytes;
}

}  // namespace

void ViewerLink::send(const v1::ServerMessage& message) {
    const std::string json = to_json(message);
    const std::lock_guard lock(mutex_);
    welcomed_ = welcomed_ || message.has_welcome();
    enqueue(json);
}

void ViewerLink::send_if_welcomed(std::string_view json) {
    const std::lock_guard lock(mutex_);
    if (welcomed_) {
        enqueue(json);
    }
}

void ViewerLink::enqueue(std::string_view json) {
    if (close_ || json.empty()) {
        return;
    }
    queued_bytes_ += json.size();
    if (queued_bytes_ > max_queued_bytes_) {
        messages_.clear();
        frame_.reset();
        light_.clear();
        light_bytes_ = 0;
        close_ = CloseRequest{CloseCode::policy_violation, "messages are not read"};
        return;
    }
    messages_.push_back(with_headroom(json));
}

bool ViewerLink::send_frame(const v1::FrameHeader& header, const std::vector<std::uint8_t>& image) {
    Frame frame{header.frame(), static_cast<int>(header.quality()),
                static_cast<double>(header.width()) * header.height(),
                frame_message(header, image, Outgoing::kHeadroom),
                header.has_key() ? std::optional(header.key()) : std::nullopt};
    const std::lock_guard lock(mutex_);
    if (close_) {
        return false;
    }
    const bool replaced = frame_.has_value();
    if (replaced && frame.key == false) {
        wants_key_ = true;
        return true;
    }
    wants_key_ = wants_key_ && frame.key != true;
    frame_ = std::move(frame);
    return replaced;
}

bool ViewerLink::has_room_for_light() const {
    const std::lock_guard lock(mutex_);
    return light_.size() < max_light_messages && light_bytes_ < max_queued_bytes_;
}

void ViewerLink::send_light(const v1::LightHeader& header, std::string_view blocks) {
    std::vector<std::uint8_t> bytes = light_message(header, blocks, Outgoing::kHeadroom);
    const std::lock_guard lock(mutex_);
    if (!close_) {
        light_bytes_ += bytes.size();
        light_.push_back(std::move(bytes));
    }
}

void ViewerLink::on_light_ack(std::uint32_t number) {
    {
        const std::lock_guard lock(mutex_);
        answers_ = true;
    }
    if (light_acks_ != nullptr) {
        light_acks_->acknowledge(viewer_, number);
    }
}

FrameAdvice ViewerLink::advise(const FrameDemand& demand, double now_ms) {
    const std::lock_guard lock(mutex_);
    FrameAdvice advice = congestion_.advise(demand, now_ms);
    advice.send = advice.send && !frame_ && !close_;
    advice.key = advice.video_bytes > 0 && wants_key_;
    return advice;
}

void ViewerLink::on_ack(const v1::Ack& ack, double now_ms) {
    const std::lock_guard lock(mutex_);
    answers_ = true;
    wants_key_ = wants_key_ || ack.wants_key();
    congestion_.on_ack(ack.frame(), ack.decode_ms(), now_ms);
}

double ViewerLink::queueing_delay_ms() const {
    const std::lock_guard lock(mutex_);
    return congestion_.queueing_delay_ms();
}

double ViewerLink::silence_ms(double now_ms) const {
    const std::lock_guard lock(mutex_);
    return congestion_.silence_ms(now_ms);
}

bool ViewerLink::acknowledged() const {
    const std::lock_guard lock(mutex_);
    return congestion_.acknowledged();
}

bool ViewerLink::answers() const {
    const std::lock_guard lock(mutex_);
    return answers_;
}

void ViewerLink::on_pong(std::string_view payload, double now_ms) {
    const std::lock_guard lock(mutex_);
    answers_ = answers_ || payload == kGreeting;
    if (payload == std::to_string(pings_)) {
        congestion_.on_probe_answered(now_ms);
    }
}

void ViewerLink::close(CloseCode code, std::string reason) {
    const std::lock_guard lock(mutex_);
    if (!close_) {
        frame_.reset();
        light_.clear();
        light_bytes_ = 0;
        close_ = CloseRequest{code, std::move(reason)};
    }
}

bool ViewerLink::closing() const {
    const std::lock_guard lock(mutex_);
    return close_.has_value();
}

bool ViewerLink::has_output() const {
    const std::lock_guard lock(mutex_);
    return !messages_.empty() || (welcomed_ && !greeted_) || frame_ || !light_.empty() || close_;
}

std::optional<Outgoing> ViewerLink::take(double now_ms) {
    const std::lock_guard lock(mutex_);
    if (!messages_.empty()) {
        Outgoing message{Outgoing::Kind::text, std::move(messages_.front())};
        messages_.pop_front();
        queued_bytes_ -= message.bytes.size() - Outgoing::kHeadroom;
        return message;
    }
    if (welcomed_ && !greeted_ && !close_) {
        greeted_ = true;
        return Outgoing{Outgoing::Kind::ping, with_headroom(kGreeting)};
    }
    if (frame_ && congestion_.wants_probe(now_ms)) {
        congestion_.on_probe_sent(now_ms);
        return Outgoing{Outgoing::Kind::ping, with_headroom(std::to_string(++pings_))};
    }
    if (frame_) {
        if (frame_->key) {
            congestion_.on_video_sent(frame_->number, frame_->bytes.size(), frame_->quality,
                                      *frame_->key, now_ms);
        } else {
            congestion_.on_sent(frame_->number, frame_->bytes.size(), frame_->quality,
                                frame_->pixels, now_ms);
        }
        Outgoing message{Outgoing::Kind::frame, std::move(frame_->bytes)};
        frame_.reset();
        return message;
    }
    if (!light_.empty()) {
        Outgoing message{Outgoing::Kind::light, std::move(light_.front())};
        light_.pop_front();
        light_bytes_ -= message.bytes.size();
        return message;
    }
    return std::nullopt;
}

std::optional<CloseRequest> ViewerLink::close_due() const {
    const std::lock_guard lock(mutex_);
    return messages_.empty() ? close_ : std::nullopt;
}

}  // namespace raybundle
