// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "net/server.h"
#include "scheduling/frame_policy.h"
#include "session/handler_result.h"
#include "session/live_scene.h"
#include "session/review/review_board.h"
#include "session/solver_demand.h"
#include "session/viewers/viewer_pictures.h"
#include "session/viewers/viewers.h"

namespace raybundle {

/// Handles what people leave for each other when they look at a scene together: pins, viewpoints,
/// pointing. Keeps the light at pins up to date.
class ReviewService {
  public:
    struct Parts {
        LiveScene& scene;
        const Viewers& viewers;
        ViewerPictures& pictures;
        const SolverDemand& demand;
        const FramePolicy& policy;
        Server& server;
    };
    explicit ReviewService(const Parts& parts);

    HandlerResult add_pin(ViewerSession& session, const ClientEvent& event);
    HandlerResult remove_pin(ViewerSession& session, const ClientEvent& event);
    HandlerResult reply_to_pin(ViewerSession& session, const ClientEvent& event);
    HandlerResult set_pin(ViewerSession& session, const ClientEvent& event);
    HandlerResult save_viewpoint(ViewerSession& session, const ClientEvent& event);
    HandlerResult remove_viewpoint(ViewerSession& session, const ClientEvent& event);
    HandlerResult point_at(ViewerSession& session, const ClientEvent& event);
    HandlerResult list_changes(ViewerSession& session, const ClientEvent& event);

    /// What a newcomer is told.
    void fill_welcome(v1::Welcome* welcome) const { board_.fill_welcome(welcome); }

    /// A pin or viewpoint of another server of the project.
    void follow(const LogEntry& note);
    /// Takes in the topics of a BCF archive, see read_bcf(): those that are pins of this scene
    /// bring replies and states, the others become pins. Everybody hears of them. All or nothing.
    DocumentResult import_pins(const std::vector<v1::PinChanged>& topics);

    /// Looks at the light of one pin, and tells everybody where it has changed.
    void check_pin();

  private:
    void announce(const ClientEvent& event, const v1::ServerMessage& message);
    bool answer_kept(const ClientEvent& event);
    void refuse(const ClientEvent& event);
    [[nodiscard]] Pin placed(const v1::PinChanged& topic);
    [[nodiscard]] std::optional<std::uint32_t> named_side(const ViewerSession& session,
                                                          const ClientEvent& event);
    void announce_pin(const ClientEvent& event, const Pin* pin);
    void measure(ViewerSession& session, Pin& pin);
    [[nodiscard]] bool worth_refining(const Pin& pin) const;
    [[nodiscard]] bool refine(Pin& pin);

    Parts parts_;
    ReviewBoard board_;
};

}  // namespace raybundle
