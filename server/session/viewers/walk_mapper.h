// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "net/ws/client_event.h"
#include "scene/scene.h"
#include "scene/walk/walk_map.h"

namespace raybundle {

/// Makes maps of what stands around viewers, on a thread of its own: one map after the other, in
/// turn, with pauses. Of each viewer one request waits; a newer one replaces it.
class WalkMapper {
  public:
    /// Calls `answer` for each request: on the mapper's thread with its map, or on the caller's
    /// thread without one if a newer request has replaced it. The scene must outlive the mapper and
    /// keep its triangles, vertices and objects but for their places, or change them under
    /// `geometry`.
    using Answer = std::function<void(const ClientEvent& request, const std::optional<WalkMap>& map,
                                      std::uint32_t epoch)>;
    /// rest: after each map, times the work on it.
    /// geometry: held while the scene's triangles are read; null: they never change.
    WalkMapper(const Scene& scene, double rest, Answer answer, std::mutex* geometry = nullptr);

    /// Takes a getWalkMap, with objects at their present places. On the thread that moves them.
    void ask(const ClientEvent& request, std::uint32_t epoch);

  private:
    struct Job {
        ClientEvent request;
        std::vector<glm::mat4> worlds;
        std::uint32_t epoch = 0;
    };

    void run(const std::stop_token& token);
    [[nodiscard]] WalkMap map_of(const std::vector<glm::mat4>& worlds, const glm::vec3& eye) const;

    const Scene& scene_;
    const double rest_;
    const Answer answer_;
    std::mutex* const geometry_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::deque<Job> jobs_;
    std::jthread thread_;
};

}  // namespace raybundle
