// SPDX-License-Identifier: Apache-2.0
#include "session/light/light_broadcaster.h"

#include <chrono>
#include <utility>

namespace raybundle {

namespace {

constexpr std::chrono::milliseconds longest_wait(1000);

}  // namespace

LightBroadcaster::LightBroadcaster(Server& server, const Clock& clock, Sent sent)
    : server_(server),
      clock_(clock),
      sent_(std::move(sent)),
      thread_([this](const std::stop_token& token) { run(token); }) {}

LightBroadcaster::~LightBroadcaster() {
    thread_.request_stop();
    server_.light_acks().interrupt();
}

void LightBroadcaster::begin(std::uint32_t scene, std::vector<LightBlock> blocks) {
    const std::lock_guard lock(mutex_);
    mail_ = {};
    mail_.begun = {scene, std::move(blocks)};
    server_.light_acks().interrupt();
}

void LightBroadcaster::add(ViewerId viewer) {
    const std::lock_guard lock(mutex_);
    mail_.added.insert(viewer);
    server_.light_acks().interrupt();
}

void LightBroadcaster::remove(ViewerId viewer) {
    const std::lock_guard lock(mutex_);
    mail_.added.erase(viewer);
    mail_.views.erase(viewer);
    mail_.removed.insert(viewer);
    server_.light_acks().interrupt();
}

void LightBroadcaster::look(ViewerId viewer, const LightView& view) {
    const std::lock_guard lock(mutex_);
    mail_.views.insert_or_assign(viewer, view);
}

void LightBroadcaster::publish(std::vector<std::uint32_t> values, const Figures& figures) {
    const std::lock_guard lock(mutex_);
    mail_.published = {std::move(values), figures};
    server_.light_acks().interrupt();
}

void LightBroadcaster::run(const std::stop_token& token) {
    while (!token.stop_requested()) {
        const LightAcks::Numbers acknowledged = server_.light_acks().take(
            [this](ViewerId viewer) { return followers_.contains(viewer); }, longest_wait);
        Mail mail;
        {
            const std::lock_guard lock(mutex_);
            mail = std::exchange(mail_, {});
        }
        const bool all = take_mail(std::move(mail));
        acknowledge(acknowledged);
        for (auto& [viewer, follower] : followers_) {
            if (all || follower.waits || acknowledged.contains(viewer)) {
                serve(viewer, follower);
            }
        }
    }
}

bool LightBroadcaster::take_mail(Mail mail) {
    if (mail.begun) {
        scene_ = mail.begun->first;
        stream_.emplace(std::move(mail.begun->second));
        followers_.clear();
    }
    for (const ViewerId viewer : mail.removed) {
        followers_.erase(viewer);
    }
    for (const ViewerId viewer : mail.added) {
        followers_.insert_or_assign(viewer, Follower{});
    }
    for (const auto& [viewer, view] : mail.views) {
        if (const auto found = followers_.find(viewer); found != followers_.end()) {
            found->second.view = view;
        }
    }
    if (mail.published && stream_) {
        figures_ = mail.published->figures;
        stream_->publish(mail.published->values);
    }
    return mail.published.has_value() || !mail.added.empty();
}

void LightBroadcaster::acknowledge(const LightAcks::Numbers& numbers) {
    for (const auto& [viewer, number] : numbers) {
        if (const auto found = followers_.find(viewer); found != followers_.end()) {
            found->second.window.on_ack(number, clock_.now_ms());
            found->second.follower.acknowledge(number);
        }
    }
}

void LightBroadcaster::serve(ViewerId viewer, Follower& follower) {
    if (!stream_) {
        return;
    }
    for (;;) {
        follower.waits = !server_.has_room_for_light(viewer);
        const auto message = follower.waits ? std::nullopt
                                            : follower.follower.next(*stream_, follower.view,
                                                                     follower.window.bytes());
        if (!message) {
            return;
        }
        v1::LightHeader header;
        header.set_light(message->number);
        header.set_scene(scene_);
        header.set_epoch(figures_.epoch);
        header.set_iterations(figures_.iterations);
        follower.window.on_sent(message->number, message->bytes->size(), clock_.now_ms());
        server_.send_light(viewer, header, *message->bytes);
        sent_(message->bytes->size());
    }
}

}  // namespace raybundle
