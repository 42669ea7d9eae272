// SPDX-License-Identifier: Apache-2.0
#include "session/viewers/frame_dispatcher.h"

#include <algorithm>
#include <utility>

#include "gpu/egl_context.h"

namespace raybundle {

namespace {

constexpr int encoder_threads = 1;

}  // namespace

FrameDispatcher::FrameDispatcher(const Parts& parts)
    : parts_(parts),
      encoder_(encoder_threads, [&metrics = parts.metrics, &server = parts.server,
                                 &traces = parts.traces](const EncodedFrame& frame) {
          metrics.count_frame(frame.bytes.size());
          server.send_frame(frame.viewer, frame.header, frame.bytes);
          traces.note_frame(frame.viewer, frame.header.epoch(), frame.bytes.size());
          server.inbox().interrupt();
      }) {}

bool FrameDispatcher::send() {
    const bool collected = collect();
    if (!draw() && !collected) {
        return false;
    }
    collect();
    return true;
}

bool FrameDispatcher::collect() {
    bool any = false;
    for (const auto& [id, session] : parts_.viewers) {
        if (session->frame_finished()) {
            DepthMap depths = session->take_depths();
            auto [header, pixels] = session->take_frame();
            encoder_.submit({id,
                             header,
                             {pixels.begin(), pixels.end()},
                             false,
                             std::move(depths),
                             session->video_bytes()});
            any = true;
        }
    }
    return any;
}

/// Draws due frames, shared out by measured time, for one slice at most. True if there were any.
bool FrameDispatcher::draw() {
    const Clock& clock = parts_.policy.clock();
    const TimePoint begun = clock.now();
    DueFrames due = due_frames();
    parts_.metrics.set_video_load(encoder_.video_load());
    const std::vector<ViewerLoad> loads = parts_.viewers.loads();
    parts_.policy.begin_frames(loads, due.moving);
    const bool anybody_moves = parts_.policy.moving_frames_ms(loads) > 0.0;
    const double slice_ms = parts_.policy.frame_slice_ms(due.moving);
    const bool any = !due.requests.empty();
    while (!due.requests.empty() && clock.ms_since(begun) < slice_ms) {
        const ViewerId viewer = *parts_.policy.next_frame(due.requests);
        draw_frame({viewer, due.advices.at(viewer)});
        std::erase_if(due.requests, [&](const FrameRequest& r) { return r.viewer == viewer; });
    }
    return greet(due, anybody_moves) || any;
}

FrameDispatcher::DueFrames FrameDispatcher::due_frames() {
    const TimePoint now = parts_.policy.clock().now();
    ChangePolicy& changes = parts_.policy.changes();
    DueFrames due;
    for (const auto& [id, session] : parts_.viewers) {
        note_silence(*session);
        if (session->end_video(now)) {
            encoder_.end_video(id);
        }
        // While a change is being worked in, the picture is between two states.
        if (parts_.scene.solver().correcting()) {
            continue;
        }
        const bool watches = !session->paused() && session->acknowledged();
        if (!watches || encoder_.busy(id) || !session->awaits_frame() ||
            session->draws_itself(now)) {
            changes.excuse(id);
        }
        if (!session->due(now) || encoder_.busy(id)) {
            continue;
        }
        const FrameAdvice advice = parts_.server.advise(id, session->demand(now));
        if (!advice.send) {
            changes.excuse(id);
            continue;
        }
        if (session->has_image() || session->acknowledged()) {
            due.requests.push_back({id, session->moving(now)});
            due.advices[id] = advice;
            due.moving = due.moving || session->moving(now);
        } else {
            (parts_.server.answers(id) ? due.newcomers : due.silent).push_back({id, advice});
        }
    }
    return due;
}

/// A viewer that acknowledges nothing counts as away, and its picture is forgotten after a while.
void FrameDispatcher::note_silence(ViewerSession& session) {
    const ViewerPaceSettings& pace = parts_.policy.settings().viewers;
    const double silence_ms = parts_.server.silence_ms(session.id());
    session.set_paused(silence_ms > pace.away_after_ms);
    if (silence_ms > pace.forget_after_ms) {
        parts_.pictures.drop(session);
    }
    if (!session.acknowledged() && parts_.server.acknowledged(session.id())) {
        session.note_acknowledged();
    }
}

void FrameDispatcher::draw_frame(const Wanted& wanted) {
    ViewerSession& session = parts_.viewers.at(wanted.viewer);
    const Clock& clock = parts_.policy.clock();
    const TimePoint begun = clock.now();
    session.set_moving_scale(parts_.policy.moving_scale(), begun);
    try {
        parts_.pictures.prepare(session);
        session.render(wanted.advice, figures(), begun);
    } catch (const GpuError& error) {
        parts_.pictures.refuse(session, error);
    }
    const double cost_ms = clock.ms_since(begun);
    session.note_frame_cost(cost_ms);
    parts_.policy.note_frame(wanted.viewer, cost_ms, session.drawn_pixels());
}

/// First frames: as many as a slice has time for; while somebody moves, one at a time within a
/// budget. Connections that nobody reads do not delay those that answer. True if there were any.
bool FrameDispatcher::greet(const DueFrames& due, bool anybody_moves) {
    if (anybody_moves) {
        const bool answering = greet_within_budget(true, due.newcomers);
        return greet_within_budget(false, due.silent) || answering;
    }
    const std::vector<Wanted>& first = due.newcomers.empty() ? due.silent : due.newcomers;
    draw_first_frames(first, parts_.policy.frame_slice_ms(false));
    return !first.empty();
}

bool FrameDispatcher::greet_within_budget(bool answers, std::span<const Wanted> newcomers) {
    if (newcomers.empty() || !parts_.policy.may_greet(answers)) {
        return false;
    }
    const Clock& clock = parts_.policy.clock();
    const TimePoint begun = clock.now();
    draw_first_frames(newcomers, 0.0);
    parts_.policy.note_greeting(answers, clock.ms_since(begun));
    return true;
}

/// First frames, all of the shared picture: one at least, more until the time is up.
void FrameDispatcher::draw_first_frames(std::span<const Wanted> newcomers, double slice_ms) {
    const Clock& clock = parts_.policy.clock();
    const TimePoint begun = clock.now();
    for (const Wanted& wanted : newcomers) {
        ViewerSession& session = parts_.viewers.at(wanted.viewer);
        try {
            ViewerImage& picture = parts_.pictures.first_look(session);
            auto [header, pixels] =
                session.render_first(picture, wanted.advice, figures(), clock.now());
            encoder_.submit({wanted.viewer,
                             header,
                             {pixels.begin(), pixels.end()},
                             false,
                             {},
                             session.video_bytes()});
        } catch (const GpuError& error) {
            parts_.pictures.refuse(session, error);
        }
        if (clock.ms_since(begun) >= slice_ms) {
            return;
        }
    }
}

bool FrameDispatcher::smooth() {
    if (parts_.scene.solver().correcting()) {
        return false;
    }
    const TimePoint now = parts_.policy.clock().now();
    return std::any_of(parts_.viewers.begin(), parts_.viewers.end(), [now](const auto& entry) {
        return !entry.second->paused() && entry.second->smooth(now);
    });
}

v1::FrameHeader FrameDispatcher::figures() const {
    const Solver& solver = parts_.scene.solver();
    v1::FrameHeader header;
    header.set_epoch(parts_.scene.epoch());
    header.set_iterations(static_cast<std::uint32_t>(solver.iterations()));
    header.set_settled(static_cast<float>(solver.statistics().settled));
    return header;
}

}  // namespace raybundle
