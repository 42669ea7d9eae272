// SPDX-License-Identifier: Apache-2.0
#include "session/render_loop.h"

#include <spdlog/spdlog.h>

#include <set>
#include <utility>
#include <vector>

#include "gpu/egl_context.h"
#include "session/message_handlers.h"
#include "session/rehearsal.h"
#include "session/viewers/picture_refusal.h"

namespace raybundle {

namespace {

constexpr std::chrono::milliseconds idle_wait(50);

}  // namespace

RenderLoop::RenderLoop(Scene scene, PatchMesh mesh, const RenderLoopSettings& settings,
                       Server& server, ChangeLog& log, const Clock& clock)
    : state_(std::move(scene), std::move(mesh), settings, server, log, clock),
      services_(state_, settings),
      rehearse_(settings.rehearse) {}

void RenderLoop::rehearse(const std::atomic<bool>& stop) {
    if (rehearse_ && state_.viewers.empty() && state_.live.solver().iterations() == 0) {
        rehearse_pictures(state_.live, stop);
    }
}

void RenderLoop::run(const std::atomic<bool>& stop) {
    services_.status.begin();
    services_.reports.step();  // whoever is welcomed may ask for documents
    bool idle = true;
    while (!stop) {
        state_.metrics.count_turn();
        process_inbox(idle);
        idle = !turn();
        if (idle) {
            state_.server.inbox().wait_for(idle_wait);
        }
    }
}

/// One round of what is due. False: there was nothing to do.
bool RenderLoop::turn() {
    services_.follower.step();
    services_.changes.start_pending();
    services_.sharing.step();
    const bool sent = services_.frames.send();
    send_solutions();
    services_.presence.hear_peers();
    services_.presence.send();
    services_.light.step();
    services_.errors.check_pictures();
    services_.measurements.step();
    services_.reports.step();
    const bool smoothed = services_.frames.smooth();
    const bool solved = services_.solver.step();
    return sent || smoothed || solved;
}

void RenderLoop::send_solutions() {
    services_.status.update_metrics();
    if (services_.status.due()) {
        services_.review.check_pin();
        services_.snapshot_queue.report();
        services_.traces.expire();
        services_.status.send_solutions();
    }
}

/// Handles what has come in by now. While frames and iterations want the time (not `idle`),
/// requests of a viewer that has had its share of it wait.
void RenderLoop::process_inbox(bool idle) {
    Inbox& inbox = state_.server.inbox();
    for (std::size_t left = inbox.size(); left > 0; --left) {
        const auto event =
            inbox.take(idle ? std::set<ViewerId>() : state_.policy.exhausted_requests());
        if (!event) {
            return;
        }
        handle(*event);
    }
}

void RenderLoop::handle(const ClientEvent& event) {
    if (event.kind == ClientEvent::Kind::joined && !event.caller) {
        services_.arrivals.join(event);
        return;
    }
    const Clock& clock = state_.policy.clock();
    const TimePoint begun = clock.now();
    if (event.kind == ClientEvent::Kind::joined) {
        services_.arrivals.join(event);
        state_.policy.note_request(event.payer(), clock.ms_since(begun), state_.viewers.size());
        return;
    }
    ViewerSession* const session = state_.viewers.find(event.viewer);
    if (session == nullptr) {
        return;
    }
    if (event.kind == ClientEvent::Kind::left) {
        services_.forget(state_, event.viewer);
        return;
    }
    handle_message(*session, event);
    state_.policy.note_request(event.payer(), clock.ms_since(begun), state_.viewers.size());
}

void RenderLoop::handle_message(ViewerSession& session, const ClientEvent& event) {
    const HandleMessage handler = handler_of(event.message.body_case());
    if (handler == nullptr) {
        state_.server.reply_error(event, v1::Error::UNIMPLEMENTED,
                                  "this version of the server does not support this message");
        return;
    }
    try {
        if (handler(services_, session, event) == HandlerResult::ok) {
            state_.server.reply_ok(event);
        }
    } catch (const GpuError& error) {
        spdlog::error("viewer {}: {}", event.viewer, error.what());
        state_.pictures.drop(session);
        const Refusal refusal = refusal_of(error);
        state_.server.reply_error(event, refusal.code, refusal.text);
    }
}

void RenderLoop::refuse_waiting() {
    services_.snapshot_queue.refuse_all();
    std::vector<ClientEvent> waiting = state_.server.inbox().drain();
    const std::vector<ClientEvent> changes = services_.changes.take_requests();
    waiting.insert(waiting.end(), changes.begin(), changes.end());
    for (const ClientEvent& event : waiting) {
        if (event.kind == ClientEvent::Kind::message) {
            state_.server.reply_error(event, v1::Error::UNAVAILABLE, "the server is stopping");
        }
    }
}

}  // namespace raybundle
