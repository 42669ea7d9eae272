// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "net/server.h"
#include "scheduling/clock.h"
#include "scheduling/scheduling_settings.h"
#include "session/handler_result.h"
#include "session/light/light_broadcaster.h"
#include "session/live_scene.h"
#include "session/loop_metrics.h"
#include "session/viewers/viewer_session.h"
#include "view/light_values.h"
#include "walkthrough/live/live_geometry.h"

namespace raybundle {

/// Serves the light itself to viewers that draw by themselves: tells them the geometry, materials
/// and sky, has the GPU read the light back between groups of iterations, and hands it to the
/// broadcaster. Does nothing as long as nobody asks.
class LightService {
  public:
    struct Parts {
        LiveScene& scene;
        const Clock& clock;
        const ViewerPaceSettings& pace;
        Server& server;
        LoopMetrics& metrics;
    };
    explicit LightService(const Parts& parts) : parts_(parts) {}

    /// A viewer whose hello asks for light, after its welcome.
    void join(const ViewerSession& session);
    /// A viewer has left.
    void forget(ViewerId viewer);
    HandlerResult set_drawing(ViewerSession& session, const ClientEvent& event);
    /// A viewer's camera is elsewhere.
    void look(const ViewerSession& session);

    /// What is due of it, each turn of the loop. Never waits.
    void step();

  private:
    struct Made {
        LiveGeometry geometry;
        std::string url;
        std::uint32_t epoch = 0;  ///< of the scene that it was made of
        std::vector<Material> materials;
    };
    struct MadeSky {
        LiveSky sky;
        std::string url;
    };

    void follow_scene();
    void make_geometry();
    void take_geometry();
    void follow_materials();
    void follow_sky();
    void take_sky();
    void read_light();
    [[nodiscard]] bool light_is_due() const;
    void announce(ViewerId viewer);
    void tell_all(const v1::ServerMessage& message);
    [[nodiscard]] v1::ServerMessage material_message(std::size_t material) const;

    Parts parts_;
    std::set<ViewerId> viewers_;
    std::unique_ptr<LightBroadcaster> broadcaster_;  // from the first viewer on
    // Geometry that is served, and another one on its way.
    std::optional<Made> made_;
    std::future<Made> making_;
    std::uint32_t scenes_ = 0;
    glm::uvec3 size_{0};  // of the scene that it is made of: triangles, vertices, objects
    // What has been told of materials and sky.
    std::vector<std::optional<v1::ServerMessage>> materials_;
    Sky sky_;
    std::optional<v1::ServerMessage> sky_message_;
    std::future<MadeSky> making_sky_;
    bool sky_is_old_ = false;
    // The light.
    std::optional<LightValues> values_;
    const Solver* read_of_ = nullptr;
    std::vector<std::uint32_t> emission_;
    std::uint32_t epoch_ = 0;       // that all this follows
    std::uint64_t fade_steps_ = 0;  // likewise
    std::uint64_t read_steps_ = 0;  // that the light was read after, or is being
    TimePoint last_change_, last_read_;
    LightBroadcaster::Figures read_;  // what is being read, or was last
};

}  // namespace raybundle
