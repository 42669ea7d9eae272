// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "net/server.h"

namespace raybundle {

/// Tells viewers how far a scene is that is being made ready: before their welcome, which the
/// render thread sends, since it is the one that reads the scene and compiles its shaders. Must
/// outlive the server's network thread.
class Preparation {
  public:
    explicit Preparation(Server& server);
    Preparation(const Preparation&) = delete;
    Preparation& operator=(const Preparation&) = delete;

    /// From now on whoever says hello hears of the scene of this file, at READING.
    void begin(const std::string& file);
    /// It has got so far: all hear who have said hello since begin().
    void reach(v1::SceneOpening::Stage stage);
    /// The render thread answers hellos itself.
    void end();

  private:
    void joined(ViewerId viewer);

    Server& server_;
    std::mutex mutex_;
    std::optional<v1::ServerMessage> message_;  // nothing: no scene is being made ready
    std::vector<ViewerId> waiting_;
};

}  // namespace raybundle
