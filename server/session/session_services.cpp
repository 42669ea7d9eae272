// SPDX-License-Identifier: Apache-2.0
#include "session/session_services.h"

namespace raybundle {

SessionServices::SessionServices(SessionState& s, const RenderLoopSettings& settings)
    : snapshot_queue(
          s.server, s.policy.clock(), s.policy.settings().snapshots,
          [&live = s.live](std::uint32_t epoch) { return make_earlier_scene(live, epoch); }),
      snapshots({s.live, snapshot_queue, s.receivers, s.server}),
      lighting({s.live, s.server}),
      traces(settings.spans, s.live.scene().name),
      animations({s.live, s.viewers, traces, s.server}, s.policy.clock()),
      changes({s.live, s.viewers, s.pictures, s.receivers, snapshot_queue, lighting.scenes(),
               animations, s.demand, s.policy.changes(), traces, s.server, s.metrics}),
      errors({s.live, s.viewers, s.policy}),
      solver({s.live, s.viewers, s.receivers, snapshot_queue, changes, errors, s.demand, s.policy,
              s.server, s.metrics, settings.lost_after_change}),
      frames({s.live, s.viewers, s.pictures, s.policy, traces, s.server, s.metrics}),
      presence({s.viewers, s.policy, s.live.log(), s.server}),
      light({s.live, s.policy.clock(), s.policy.settings().viewers, s.server, s.metrics}),
      views({s.live, presence, light, s.policy, s.server}),
      admission({s.viewers, s.policy, s.server, settings.software_rendering}),
      probes({s.live, s.pictures, s.server}),
      measurements({s.live, s.policy, s.server}),
      review({s.live, s.viewers, s.pictures, s.demand, s.policy, s.server}),
      reports({s.live, measurements, lighting.scenes(), review, s.server}),
      scenes({s.live, s.server, settings.scene_requests, settings.effect_requests}),
      arrivals({s.live,
                s.viewers,
                admission,
                views,
                review,
                measurements,
                lighting.scenes(),
                animations,
                presence,
                light,
                s.server,
                s.metrics,
                {settings.renderer, settings.software_rendering,
                 static_cast<bool>(settings.scene_requests)},
                s.policy.clock()}),
      sharing({s.live, s.policy.clock(), settings.exchange, settings.fingerprint}),
      status({s.live, s.viewers, s.pictures, s.policy, sharing, s.server, s.metrics}),
      follower({s.live, changes, lighting, review, views, measurements}) {}

void SessionServices::forget(SessionState& state, ViewerId viewer) {
    frames.forget(viewer);
    traces.forget(viewer);
    state.policy.forget(viewer);
    snapshots.forget(viewer);
    measurements.forget(viewer);
    ViewerSession& session = state.viewers.at(viewer);
    state.pictures.forget(session);
    if (!session.is_caller()) {
        presence.forget(viewer);
        light.forget(viewer);
    }
    state.viewers.erase(viewer);
}

}  // namespace raybundle
