// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/opening_times.h"
#include "net/server.h"

namespace raybundle {

/// Tells viewers how far a scene is that is being made ready: before their welcome, which the
/// render thread sends, since it is the one that reads the scene and compiles its shaders. Says it
/// again now and then, so that nobody takes a long step for a dead server. Must outlive the
/// server's network thread.
class Preparation {
  public:
    using Clock = std::chrono::steady_clock;

    /// What is prepared is noted in `times`.
    Preparation(Server& server, OpeningTimes& times);
    Preparation(const Preparation&) = delete;
    Preparation& operator=(const Preparation&) = delete;

    /// From now on whoever says hello hears of the scene of this file, at READING. asked_for: when
    /// it was; nothing where it is not read anew.
    void begin(const std::string& file, std::optional<Clock::time_point> asked_for);
    /// It has got so far: all hear who have said hello since begin().
    void reach(v1::SceneOpening::Stage stage);
    /// The render thread answers hellos itself.
    void end();

  private:
    void joined(ViewerId viewer);
    void repeat(const std::stop_token& token);
    [[nodiscard]] v1::ServerMessage news() const;
    void tell_all();

    Server& server_;
    OpeningTimes& times_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::optional<v1::ServerMessage> message_;  // nothing: no scene is being made ready
    std::string file_;
    std::optional<Clock::time_point> asked_for_;
    std::optional<Clock::time_point> light_since_;  // at COMPILING
    std::vector<ViewerId> waiting_;
    std::jthread repeater_;
};

}  // namespace raybundle
