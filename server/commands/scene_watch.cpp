// SPDX-License-Identifier: Apache-2.0
#include "commands/scene_watch.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>
#include <utility>

namespace raybundle {
namespace {

namespace fs = std::filesystem;

constexpr auto poll_interval = std::chrono::milliseconds(500);

/// What tells one version of a file from the next; all zero while there is none.
struct FileState {
    fs::file_time_type changed{};
    std::uintmax_t size = 0;

    bool operator==(const FileState&) const = default;
};

FileState state_of(const std::string& file) {
    std::error_code missing;
    FileState state{fs::last_write_time(file, missing), 0};
    if (missing) {
        return {};
    }
    state.size = fs::file_size(file, missing);
    return missing ? FileState{} : state;
}

}  // namespace

SceneWatch::SceneWatch(const Options& options, std::function<void()> replaced)
    : options_(options), replaced_(std::move(replaced)) {
    thread_ = std::jthread([this](const std::stop_token& token) { watch(token); });
}

std::optional<LoadedScene> SceneWatch::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(loaded_, std::nullopt);
}

void SceneWatch::watch(const std::stop_token& token) {
    FileState known = state_of(options_.scene);
    FileState before = known;
    while (!token.stop_requested()) {
        std::this_thread::sleep_for(poll_interval);
        const FileState now = state_of(options_.scene);
        const bool settled = now == before && now != FileState{};
        before = now;
        if (settled && now != known) {
            known = now;
            load();
        }
    }
}

void SceneWatch::load() {
    try {
        LoadedScene loaded = load_scene(options_);
        {
            const std::lock_guard lock(mutex_);
            loaded_ = std::move(loaded);
        }
        replaced_();
    } catch (const std::exception& error) {
        spdlog::error("the scene stays as it was: {}", error.what());
    }
}

}  // namespace raybundle
