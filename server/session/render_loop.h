// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <string>

#include "scheduling/clock.h"
#include "session/render_loop_settings.h"
#include "session/session_services.h"
#include "session/session_state.h"

namespace raybundle {

/// Serves one scene on the calling thread, the only one that touches the GPU: answers viewers'
/// messages, makes changes, sends frames, and gives the rest of the time to iterations. Says what
/// comes when; the services do it.
class RenderLoop {
  public:
    RenderLoop(Scene scene, PatchMesh mesh, const RenderLoopSettings& settings, Server& server,
               ChangeLog& log, const Clock& clock = steady_clock());

    /// Does once all that viewers and moves need, where the settings say so and nothing has been
    /// iterated yet: it takes long. Ends early when `stop` is set. Throws GpuError as run() does.
    void rehearse(const std::atomic<bool>& stop);

    /// Runs until `stop` is set and the inbox is interrupted. Throws GpuError where the GPU has
    /// lost its memory, or has not enough of it for the solution.
    void run(const std::atomic<bool>& stop);

    /// Answers what still waits when the loop has ended.
    void refuse_waiting();

    /// Prometheus text; any thread.
    [[nodiscard]] std::string metrics() const { return state_.metrics.text(); }

  private:
    bool turn();
    void send_solutions();
    void process_inbox(bool idle);
    void handle(const ClientEvent& event);
    void handle_message(ViewerSession& session, const ClientEvent& event);

    SessionState state_;
    SessionServices services_;
    bool rehearse_ = false;
};

}  // namespace raybundle
