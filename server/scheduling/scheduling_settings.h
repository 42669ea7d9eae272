// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace raybundle {

/// Weights of viewers in FrameScheduler.
struct FrameShareSettings {
    double moving_quantum_ms = 20.0;  ///< what a round gives a viewer whose picture moves
    double resting_quantum_ms = 5.0;  ///< and one whose picture rests
    double unknown_cost_ms = 10.0;    ///< assumed for a viewer's first frame
    double max_cost_ms = 10000.0;     ///< longer measurements are cut
    double smoothing = 0.3;           ///< weight of a new measurement
};

/// A share of the time in the long run, and what may be saved up.
struct BudgetSettings {
    double share = 1.0;
    double burst_ms = 0.0;
};

/// What a frame and an iteration have to share while somebody walks, and what while nobody does.
struct RoundSettings {
    double frame_slice_ms = 60.0;  ///< frames between two steps of the solver
    double slice_steps = 2.0;      ///< or so many steps of the solver while somebody moves
    /// A frame of everyone who walks, and a step; 50 ms with encoding: 20 frames a second.
    double walk_round_ms = 40.0;
    double walk_pause_ms = 250.0;   ///< without a frame in motion for so long nobody walks
    double min_solver_share = 0.2;  ///< of the time, where frames take more than the rest
    double solver_burst_ms = 50.0;  ///< what the solver may save up meanwhile
};

/// What gathering light in viewers' pixels may add to an iteration.
struct ReceiverSettings {
    double min_moving_ms = 40.0;  ///< while somebody moves, or
    double frames_share = 0.5;    ///< so much of what frames in motion take, where that is more
    double resting_ms = 100.0;    ///< while nobody moves: who begins to must not wait long
};

/// Sizes of pictures in motion.
struct MovingScaleSettings {
    double min = 0.625;        ///< of width and height
    double step = 1.0 / 16.0;  ///< likewise
};

/// Special phases, and what comes between two changes.
struct ChangeSettings {
    /// Of the 150 ms from a change to its frame what composing and encoding leave.
    double phase_deadline_ms = 110.0;
    double phase_smoothing = 0.3;  ///< weight of the newest phase in means
    double drag_pause_ms = 400.0;  ///< without a step for so long nobody drags
    /// Of the time of changes and their frames, as beside frames of a walk.
    double iteration_share = 0.2;
};

/// When a viewer counts as moving or away, and how often its picture is worth a frame or a look.
struct ViewerPaceSettings {
    double moving_s = 0.4;  ///< after its last change a viewer counts as moving
    /// The same for one whose page draws by itself meanwhile: it sends a camera with each of its
    /// frames, which are 133 ms apart where every second one is late at 15 a second.
    double drawn_rest_s = 0.15;
    double moving_interval_s = 0.016;     ///< between frames of a picture that has changed
    double refining_share = 0.1;          ///< between frames of one that refines: of its age
    double min_refining_s = 0.1;          ///< but never less than this
    double max_refining_s = 1.0;          ///< nor more
    double cost_smoothing = 0.2;          ///< weight of a new measurement of a frame in motion
    double away_after_ms = 3000.0;        ///< without acknowledgement a viewer counts as away
    double forget_after_ms = 60e3;        ///< and after this its picture is forgotten
    double statistics_interval_s = 0.15;  ///< between two looks at the error of a picture
    double check_after_s = 1.0;           ///< of rest before its true error is measured
};

/// Snapshots beside viewers.
struct SnapshotPaceSettings {
    double share = 0.18;             ///< of the solver's time, while somebody moves
    double max_credit_ms = 500.0;    ///< that may be saved up
    double cost_smoothing = 0.1;     ///< weight of the newest iteration in the usual cost
    double earlier_slice_ms = 40.0;  ///< of iterations of an earlier scene at once
    double longest_turn_ms = 500.0;  ///< the same where all rest and nobody asks for anything
    double earlier_kept_s = 120.0;   ///< an earlier scene is kept after its last picture
    double max_time_s = 3600.0;      ///< of one snapshot, then it is delivered as it is
    double statistics_interval_s = 0.1;
    double report_interval_s = 1.0;
};

/// What viewers ask for besides frames.
struct RequestSettings {
    BudgetSettings of_one{0.25, 250.0};  ///< of one viewer, if there are one or two
    double full_shares = 2.0;            ///< more viewers share what so many may have
};

/// First frames while others move.
struct GreetingSettings {
    BudgetSettings answering{0.1, 250.0};  ///< of viewers that have answered a ping
    BudgetSettings silent{0.03, 250.0};    ///< of connections that have answered nothing
};

/// Threads beside the render thread rest so many times as long as they have worked.
struct RestSettings {
    double error_check = 5.0;   ///< a sixth of one core
    double walk_map = 1.0;      ///< half of one core
    double first_points = 0.0;  ///< of measurements without values yet: none
    double points = 5.0;        ///< of measurements that become better: a sixth of one core
};

/// Between two messages of a kind to everybody.
struct MessagePaceSettings {
    double solution_s = 0.25;
    double min_presence_s = 0.1;          ///< at least, or
    double presence_per_viewer_s = 0.01;  ///< so much for each viewer, if that is more
};

/// All that decides who gets time: docs/scheduling.md says it in sentences.
struct SchedulingSettings {
    /// Option `minFramesPerSecond`: a viewer is refused if the others would get fewer frames; 0:
    /// nobody is.
    double min_frames_per_second = 0.0;
    /// Without viewers the solver rests after this many iterations since the last change.
    std::uint64_t idle_iterations = 4096;
    /// Several viewers are told that it is crowded if a round takes longer: attention lasts so long
    /// (R. Miller 1968).
    double crowded_ms = 1000.0;

    FrameShareSettings frames;
    RoundSettings round;
    ReceiverSettings receivers;
    MovingScaleSettings moving_scale;
    ChangeSettings changes;
    ViewerPaceSettings viewers;
    SnapshotPaceSettings snapshots;

    RequestSettings requests;
    GreetingSettings greeting;
    BudgetSettings statistics{0.1, 20.0};  ///< of pictures' errors
    RestSettings rests;
    MessagePaceSettings messages;
};

}  // namespace raybundle
