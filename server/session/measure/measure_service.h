// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "net/server.h"
#include "scheduling/frame_policy.h"
#include "session/handler_result.h"
#include "session/live_scene.h"
#include "session/measure/measure_messages.h"
#include "session/measure/point_measurer.h"
#include "session/measure/requirement_board.h"
#include "session/viewers/viewer_session.h"

namespace raybundle {

/// Measures light at points in the air: once, as long as a viewer keeps it, or, where it has a name
/// as a zone of the project, as long as nobody removes it: for all viewers, after a restart too.
class MeasureService {
  public:
    static constexpr std::size_t most_measurements = 16;  ///< of all viewers, without zones
    static constexpr std::size_t most_zones = 32;

    struct Parts {
        LiveScene& scene;
        const FramePolicy& policy;
        Server& server;
    };
    /// Takes up the zones and requirements that the journal holds.
    explicit MeasureService(const Parts& parts);

    /// Handles measure.
    HandlerResult measure(ViewerSession& session, const ClientEvent& event);
    /// Handles removeMeasurement.
    HandlerResult remove(ViewerSession& session, const ClientEvent& event);
    HandlerResult set_zone(ViewerSession& session, const ClientEvent& event);
    HandlerResult set_requirement(ViewerSession& session, const ClientEvent& event);
    HandlerResult remove_requirement(ViewerSession& session, const ClientEvent& event);
    /// What a newcomer is told.
    void fill_welcome(v1::Welcome* welcome) const;
    /// Hands the present scene on where it is wanted, and sends what has been found.
    void step();
    void forget(ViewerId viewer);
    /// A zone, or the requirements, of another server of the project.
    void follow(const LogEntry& note);

    /// A zone for those who draw or write about it.
    struct Zone {
        const MeasureRequest& request;
        const v1::Measure& measure;
        const v1::Measured& found;  ///< as it was sent last
    };
    [[nodiscard]] std::vector<Zone> zones() const;
    [[nodiscard]] const RequirementBoard& requirements() const { return board_; }
    /// Grows with each change of a zone or a requirement.
    [[nodiscard]] std::uint64_t version() const { return version_; }

  private:
    struct Measurement {
        ViewerId viewer = 0;
        MeasureRequest request;
        std::optional<ClientEvent> unanswered;
        bool keep = false;
        TimePoint begun;
        std::optional<PointMeasurer::Result> last{};  ///< that has not been sent
        v1::JournalZone zone{};                       ///< of one with a name
        v1::Measured shown{};                         ///< likewise, as it was sent last

        [[nodiscard]] bool is_zone() const { return !zone.measure().name().empty(); }
    };

    [[nodiscard]] std::string problem_of(const ViewerSession& session, const v1::Measure& measure,
                                         const MeasureRequest& request,
                                         v1::Error::Code& code) const;
    void refuse_unsaved(const ClientEvent& event, const std::string& text) const;
    [[nodiscard]] bool keep_zone(const v1::JournalZone& zone);
    [[nodiscard]] Measurement* find_zone(std::uint32_t number);
    void restore_zones();
    bool take_up(v1::JournalZone zone);
    void drop(std::uint32_t number);
    [[nodiscard]] std::optional<std::uint32_t> new_number(bool zone);
    void note_number(std::uint32_t number);
    void tell_requirements();
    void show_again(Measurement& measurement);
    void announce_requirements(const ClientEvent& event, bool done);
    void send(Measurement& measurement);
    void send_waiting();
    [[nodiscard]] std::size_t count(bool zones) const;

    Parts parts_;
    RequirementBoard board_;
    std::map<std::uint32_t, Measurement> measurements_;
    std::map<std::uint32_t, PointMeasurer::Result> results_;  ///< newest of zones
    std::uint32_t last_number_ = 0;
    std::uint32_t last_own_number_ = 0;  ///< of those that other servers must not meet
    std::uint64_t version_ = 1;
    PointMeasurer measurer_;
};

}  // namespace raybundle
