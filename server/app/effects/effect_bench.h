// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <optional>
#include <thread>

#include "net/server.h"
#include "options/cli_options.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// Measures for viewers what the effects of a scene cost, one request at a time, on a thread and a
/// GL context of its own while the scene is served.
class EffectBench {
  public:
    EffectBench(const Options& options, Server& server) : options_(options), server_(server) {}

    /// Answers measureEffects, now or in some seconds. Any thread.
    void measure(const ClientEvent& request, const Scene& scene, const PatchMesh& mesh);

  private:
    /// The answer; none when it is to stop.
    std::optional<v1::ServerMessage> measured(const Scene& scene, const PatchMesh& mesh,
                                              const std::stop_token& stop);

    const Options& options_;
    Server& server_;
    std::atomic<bool> busy_{false};
    std::jthread thread_;
};

}  // namespace raybundle
