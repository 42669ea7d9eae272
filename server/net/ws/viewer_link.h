// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "net/ws/light_acks.h"
#include "raybundle.pb.h"
#include "stream/congestion_window.h"
#include "stream/viewer_id.h"

namespace raybundle {

/// Close codes of RFC 6455, 7.4.1, as far as they are used here.
enum class CloseCode : std::uint16_t {
    going_away = 1001,
    protocol_error = 1002,
    policy_violation = 1008,
    too_large = 1009,
    service_restart = 1012,
    try_again_later = 1013,
};

struct CloseRequest {
    CloseCode code = CloseCode::going_away;
    std::string reason;
};

/// A WebSocket message on its way out, with kHeadroom free bytes before its payload.
struct Outgoing {
    static constexpr std::size_t kHeadroom = 32;  ///< at least LWS_PRE

    enum class Kind { text, frame, light, ping };

    Kind kind = Kind::text;
    std::vector<std::uint8_t> bytes;  ///< headroom, then payload
};

/// What waits for one viewer: a bounded queue of text messages, at most one frame, and light as
/// far as its sender lets it. Filled by any
/// thread, emptied by the network thread.
class ViewerLink {
  public:
    ViewerLink(ViewerId viewer, std::size_t max_queued_bytes, const CongestionSettings& congestion)
        : viewer_(viewer), max_queued_bytes_(max_queued_bytes), congestion_(congestion) {}

    [[nodiscard]] ViewerId viewer() const { return viewer_; }

    /// Queues a message as JSON. If too many wait, drops them all and requests a close instead.
    void send(const v1::ServerMessage& message);

    /// As send() for many viewers, which has made the JSON once; skipped before the welcome.
    void send_if_welcomed(std::string_view json);

    /// Makes this the frame that waits. True where it has replaced one. A frame of video that needs
    /// the one before it takes no place: it is dropped, and a key frame asked for.
    bool send_frame(const v1::FrameHeader& header, const std::vector<std::uint8_t>& image);

    /// Messages of light that may wait: more than any window lets through where they are read.
    static constexpr std::size_t max_light_messages = 256;

    /// Whether more light may be queued, whatever the viewer acknowledges: who acknowledges, or
    /// not, and reads nothing makes nothing grow. False: later, the newest.
    [[nodiscard]] bool has_room_for_light() const;
    /// Queues a message of light; its sender asks has_room_for_light() before, and sees to it that
    /// few bytes are not acknowledged.
    void send_light(const v1::LightHeader& header, std::string_view blocks);
    /// Tells who sends light what the viewer has taken in. acks must outlive the connection.
    void report_light_to(LightAcks* acks) { light_acks_ = acks; }
    void on_light_ack(std::uint32_t number);

    FrameAdvice advise(const FrameDemand& demand, double now_ms);
    void on_ack(const v1::Ack& ack, double now_ms);

    /// Of the frame acknowledged last, above the base round trip.
    [[nodiscard]] double queueing_delay_ms() const;

    /// How long a frame has been waiting for its acknowledgement; 0 where none does.
    [[nodiscard]] double silence_ms(double now_ms) const;
    /// Whether any frame has ever been acknowledged.
    [[nodiscard]] bool acknowledged() const;

    /// Whether it has answered anything since the welcome: a connection that nobody reads has not.
    [[nodiscard]] bool answers() const;

    /// A WebSocket pong has come; `payload` tells whether it answers take()'s last ping.
    void on_pong(std::string_view payload, double now_ms);

    /// Closes once the messages that wait are written; what comes later is dropped. The first
    /// reason counts.
    void close(CloseCode code, std::string reason);

    [[nodiscard]] bool closing() const;
    [[nodiscard]] bool has_output() const;

    /// Takes the next message to write: text, then a ping after the welcome, which shows whether
    /// anybody is there, or one that measures the round trip where that is due, then the frame,
    /// then light.
    std::optional<Outgoing> take(double now_ms);

    /// The close request once nothing is left to be written before it.
    [[nodiscard]] std::optional<CloseRequest> close_due() const;

  private:
    struct Frame {
        std::uint32_t number = 0;
        int quality = 0;
        double pixels = 0.0;
        std::vector<std::uint8_t> bytes;
        std::optional<bool> key;  ///< of video
    };

    void enqueue(std::string_view json);

    const ViewerId viewer_;
    const std::size_t max_queued_bytes_;
    mutable std::mutex mutex_;
    std::deque<std::vector<std::uint8_t>> messages_;  ///< with headroom
    std::size_t queued_bytes_ = 0;
    std::optional<Frame> frame_;
    std::deque<std::vector<std::uint8_t>> light_;  ///< with headroom
    std::size_t light_bytes_ = 0;
    LightAcks* light_acks_ = nullptr;
    CongestionWindow congestion_;
    std::uint32_t pings_ = 0;  ///< sent so far to measure; its number is a ping's payload
    std::optional<CloseRequest> close_;
    bool welcomed_ = false;
    bool greeted_ = false;  ///< the ping after the welcome is sent
    bool answers_ = false;
    bool wants_key_ = false;  ///< it cannot decode the next frame of video without
};

}  // namespace raybundle
