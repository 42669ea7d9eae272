// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "net/server.h"
#include "scheduling/frame_policy.h"
#include "session/handler_result.h"
#include "session/viewers/viewers.h"

namespace raybundle {

/// How large the pictures of viewers are: what the limits, the memory and the time leave of what
/// they want.
class ViewerAdmission {
  public:
    struct Parts {
        const Viewers& viewers;
        const FramePolicy& policy;
        Server& server;
        bool software_rendering = false;  ///< pictures take the machine's memory
    };
    explicit ViewerAdmission(const Parts& parts) : parts_(parts) {}

    /// What `welcome` says of the limits.
    static void fill_limits(v1::Limits* limits);

    /// The size at which a viewport is served. One beyond the limits, or for which there is no
    /// memory, gets the largest of its shape that there is memory and time for: its client has to
    /// scale pictures anyway. `instead` is the viewer whose picture it would replace, or null.
    [[nodiscard]] glm::uvec2 served_size(glm::uvec2 wanted, const ViewerSession* instead) const;

    /// Why a picture of this size cannot be served, with what would fit; empty where it can.
    [[nodiscard]] std::string no_room_for(glm::uvec2 size, const ViewerSession* instead) const;

    /// Handles setViewport.
    HandlerResult set_viewport(ViewerSession& session, const ClientEvent& event);

  private:
    [[nodiscard]] CostModel::Verdict within_time(glm::uvec2 size,
                                                 const ViewerSession* instead) const;
    [[nodiscard]] std::optional<glm::uvec2> within_memory(glm::uvec2 size,
                                                          const ViewerSession* instead) const;

    Parts parts_;
};

}  // namespace raybundle
