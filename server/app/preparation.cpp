// SPDX-License-Identifier: Apache-2.0
#include "app/preparation.h"

#include <spdlog/spdlog.h>

#include <filesystem>

namespace raybundle {

Preparation::Preparation(Server& server) : server_(server) {
    server.inbox().set_on_joined([this](ViewerId viewer) { joined(viewer); });
}

void Preparation::joined(ViewerId viewer) {
    const std::lock_guard lock(mutex_);
    if (message_) {
        waiting_.push_back(viewer);
        server_.send(viewer, *message_);
    }
}

void Preparation::begin(const std::string& file) {
    const std::lock_guard lock(mutex_);
    message_.emplace();
    message_->mutable_scene_opening()->set_name(std::filesystem::path(file).filename().string());
    message_->mutable_scene_opening()->set_stage(v1::SceneOpening::READING);
}

void Preparation::reach(v1::SceneOpening::Stage stage) {
    const std::lock_guard lock(mutex_);
    if (!message_) {
        return;
    }
    message_->mutable_scene_opening()->set_stage(stage);
    for (const ViewerId viewer : waiting_) {
        server_.send(viewer, *message_);
    }
}

void Preparation::end() {
    const std::lock_guard lock(mutex_);
    if (message_) {
        spdlog::info("{} is ready", message_->scene_opening().name());
    }
    message_.reset();
    waiting_.clear();
}

}  // namespace raybundle
