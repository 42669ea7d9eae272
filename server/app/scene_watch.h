// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "app/load_scene.h"

namespace raybundle {

/// Reads the scene again, on a thread of its own, when its file or one that it refers to is
/// replaced. A scene that is rejected is reported in the log and changes nothing. Looks twice a
/// second, and waits until the files have stopped changing; an exporter that takes longer between
/// two of them is waited for after the rejection.
class SceneWatch {
  public:
    /// `replaced` is called when take() has something.
    SceneWatch(const Options& options, std::function<void()> replaced);

    /// The newest scene that has not been taken yet.
    std::optional<LoadedScene> take();

  private:
    void watch(const std::stop_token& token);
    void load();

    const Options options_;
    std::function<void()> replaced_;
    std::mutex mutex_;
    std::optional<LoadedScene> loaded_;
    std::jthread thread_;
};

}  // namespace raybundle
