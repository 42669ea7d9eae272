// SPDX-License-Identifier: Apache-2.0
#include "app/scene_watch.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>
#include <utility>
#include <vector>

#include "scene/gltf/file/gltf_confinement.h"

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

/// Of the scene file, then of the files that it refers to.
using FileStates = std::vector<FileState>;

FileState state_of(const std::string& file) {
    std::error_code missing;
    FileState state{fs::last_write_time(file, missing), 0};
    if (missing) {
        return {};
    }
    state.size = fs::file_size(file, missing);
    return missing ? FileState{} : state;
}

/// The scene file alone where it cannot be read.
std::vector<std::string> files_to_watch(const std::string& scene) {
    try {
        return files_of_scene(scene);
    } catch (const std::exception&) {
        return {scene};
    }
}

FileStates states_of(const std::vector<std::string>& files) {
    FileStates states;
    states.reserve(files.size());
    for (const std::string& file : files) {
        states.push_back(state_of(file));
    }
    return states;
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
    std::vector<std::string> files = files_to_watch(options_.scene.file);
    FileStates known = states_of(files);
    FileStates before = known;
    while (!token.stop_requested()) {
        std::this_thread::sleep_for(poll_interval);
        FileStates now = states_of(files);
        const bool settled = now == before && now.front() != FileState{};
        if (settled && now != known) {
            files = files_to_watch(options_.scene.file);
            known = now = states_of(files);
            load();
        }
        before = std::move(now);
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
