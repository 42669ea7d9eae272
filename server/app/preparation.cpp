// SPDX-License-Identifier: Apache-2.0
#include "app/preparation.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>

namespace raybundle {
namespace {

/// Well below the 20 s of silence after which the page takes a connection for dead.
constexpr std::chrono::seconds pause_between_news{5};

double seconds_since(Preparation::Clock::time_point start) {
    return std::chrono::duration<double>(Preparation::Clock::now() - start).count();
}

}  // namespace

Preparation::Preparation(Server& server, OpeningTimes& times) : server_(server), times_(times) {
    server.inbox().set_on_joined([this](ViewerId viewer) { joined(viewer); });
}

void Preparation::repeat(const std::stop_token& token) {
    std::unique_lock lock(mutex_);
    while (!token.stop_requested()) {
        changed_.wait(lock, token, [this] { return message_ && !waiting_.empty(); });
        changed_.wait_for(lock, token, pause_between_news, [] { return false; });
        if (!token.stop_requested()) {
            tell_all();
        }
    }
}

v1::ServerMessage Preparation::news() const {
    v1::ServerMessage message = *message_;
    const auto expected = asked_for_ ? times_.expected(file_) : std::nullopt;
    if (expected) {
        const double left = *expected - seconds_since(*asked_for_);
        message.mutable_scene_opening()->set_seconds_left(static_cast<float>(std::max(left, 0.0)));
    }
    return message;
}

void Preparation::tell_all() {
    if (message_) {
        const v1::ServerMessage message = news();
        for (const ViewerId viewer : waiting_) {
            server_.send(viewer, message);
        }
    }
}

void Preparation::joined(ViewerId viewer) {
    const std::lock_guard lock(mutex_);
    if (message_) {
        waiting_.push_back(viewer);
        server_.send(viewer, news());
        changed_.notify_all();
    }
}

void Preparation::begin(const std::string& file, std::optional<Clock::time_point> asked_for) {
    const std::lock_guard lock(mutex_);
    file_ = file;
    asked_for_ = asked_for;
    light_since_.reset();
    message_.emplace();
    message_->mutable_scene_opening()->set_name(std::filesystem::path(file).filename().string());
    message_->mutable_scene_opening()->set_stage(v1::SceneOpening::READING);
    // Not before: whoever makes this one blocks signals later, and threads inherit that.
    if (!repeater_.joinable()) {
        repeater_ = std::jthread([this](const std::stop_token& token) { repeat(token); });
    }
}

void Preparation::reach(v1::SceneOpening::Stage stage) {
    const std::lock_guard lock(mutex_);
    if (message_) {
        message_->mutable_scene_opening()->set_stage(stage);
        if (stage == v1::SceneOpening::COMPILING) {
            light_since_ = Clock::now();
        }
        tell_all();
    }
}

void Preparation::end() {
    const std::lock_guard lock(mutex_);
    if (message_) {
        spdlog::info("{} is ready", message_->scene_opening().name());
    }
    if (message_ && asked_for_) {
        times_.note(file_, seconds_since(*asked_for_),
                    light_since_ ? seconds_since(*light_since_) : 0.0);
    }
    message_.reset();
    waiting_.clear();
}

}  // namespace raybundle
