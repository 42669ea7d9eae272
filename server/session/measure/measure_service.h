// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>

#include "net/server.h"
#include "scheduling/frame_policy.h"
#include "session/handler_result.h"
#include "session/live_scene.h"
#include "session/measure/measure_messages.h"
#include "session/measure/point_measurer.h"
#include "session/viewers/viewer_session.h"

namespace raybundle {

/// Measures light for viewers at points in the air: once, or as long as they keep it.
class MeasureService {
  public:
    static constexpr std::size_t most_measurements = 16;  ///< of all viewers

    struct Parts {
        const LiveScene& scene;
        const FramePolicy& policy;
        Server& server;
    };
    explicit MeasureService(const Parts& parts);

    /// Handles measure.
    HandlerResult measure(ViewerSession& session, const ClientEvent& event);
    /// Handles removeMeasurement.
    HandlerResult remove(ViewerSession& session, const ClientEvent& event);
    /// Hands the present scene on where it is wanted, and sends what has been found.
    void step();
    void forget(ViewerId viewer);

  private:
    struct Measurement {
        ViewerId viewer = 0;
        MeasureRequest request;
        std::optional<ClientEvent> unanswered;
        bool keep = false;
        TimePoint begun;
        std::optional<PointMeasurer::Result> last;  ///< that has not been sent
    };

    void send_waiting();

    Parts parts_;
    std::map<std::uint32_t, Measurement> measurements_;
    std::uint32_t last_number_ = 0;
    PointMeasurer measurer_;
};

}  // namespace raybundle
