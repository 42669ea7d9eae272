// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <vector>

#include "net/server.h"
#include "scheduling/frame_policy.h"
#include "session/changes/change_traces.h"
#include "session/live_scene.h"
#include "session/loop_metrics.h"
#include "session/viewers/viewer_pictures.h"
#include "session/viewers/viewers.h"
#include "stream/frame_encoder.h"

namespace raybundle {

/// Draws and sends the frames that are due, in the order that the policy gives.
class FrameDispatcher {
  public:
    struct Parts {
        const LiveScene& scene;
        const Viewers& viewers;
        ViewerPictures& pictures;
        FramePolicy& policy;
        ChangeTraces& traces;
        Server& server;
        LoopMetrics& metrics;
    };
    explicit FrameDispatcher(const Parts& parts);

    /// Hands finished frames to the encoder, draws due ones for one slice at most, and hands those
    /// over that are finished at once, as with a software renderer. True if there were any.
    bool send();

    /// One slice of antialiasing of one picture, so that a camera message waits for no more. True
    /// if there was something to do.
    bool smooth();

    /// A viewer has left.
    void forget(ViewerId viewer) { encoder_.forget(viewer); }

  private:
    struct Wanted {
        ViewerId viewer = 0;
        FrameAdvice advice;
    };
    /// Who can take a frame now.
    struct DueFrames {
        std::vector<FrameRequest> requests;
        std::map<ViewerId, FrameAdvice> advices;  ///< of the requests
        std::vector<Wanted> newcomers;  ///< have never acknowledged a frame, but answered a ping
        std::vector<Wanted> silent;     ///< have never answered anything
        bool moving = false;            ///< one of the requests is of somebody who moves
    };

    bool collect();
    bool draw();
    [[nodiscard]] DueFrames due_frames();
    void note_silence(ViewerSession& session);
    void draw_frame(const Wanted& wanted);
    bool greet(const DueFrames& due, bool anybody_moves);
    bool greet_within_budget(bool answers, std::span<const Wanted> newcomers);
    void draw_first_frames(std::span<const Wanted> newcomers, double slice_ms);
    [[nodiscard]] v1::FrameHeader figures() const;

    Parts parts_;
    FrameEncoder encoder_;
};

}  // namespace raybundle
