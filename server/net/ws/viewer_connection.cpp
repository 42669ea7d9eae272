// SPDX-License-Identifier: Apache-2.0
#include "net/ws/viewer_connection.h"

#include <libwebsockets.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "net/clock.h"

namespace raybundle {
namespace {

static_assert(Outgoing::kHeadroom >= LWS_PRE);

constexpr std::size_t kPieceBytes = 65536;    ///< of one WebSocket fragment
constexpr double kCloseTimeoutS = 2.0;        ///< for a viewer to read why it is disconnected
constexpr std::size_t kMaxReasonBytes = 120;  ///< RFC 6455, 5.5: 125 less the code

lws_usec_t microseconds(double seconds) {
    return static_cast<lws_usec_t>(seconds * 1e6);
}

int write_flags(Outgoing::Kind kind, bool first, bool last) {
    if (kind == Outgoing::Kind::ping) {
        return LWS_WRITE_PING;
    }
    return lws_write_ws_flags(kind == Outgoing::Kind::text ? LWS_WRITE_TEXT : LWS_WRITE_BINARY,
                              static_cast<int>(first), static_cast<int>(last));
}

}  // namespace

ViewerConnection::ViewerConnection(lws* connection, NetworkState& state, std::string peer)
    : connection_(connection),
      state_(state),
      link_(state.viewers.add(state.settings.max_queued_bytes, state.settings.congestion)),
      session_(*link_, state.inbox, state.gate, state.settings.limits,
               state.settings.max_messages_per_second, peer, state.settings.audit.get()),
      peer_(std::move(peer)),
      hello_deadline_ms_(server_time_ms() + 1000.0 * state.settings.hello_timeout_s) {
    set_timer();
    spdlog::info("viewer {} connected from {}", link_->viewer(), peer_);
}

ViewerConnection::~ViewerConnection() {
    session_.on_closed();
    state_.viewers.remove(link_->viewer());
    spdlog::info("viewer {} disconnected from {}", link_->viewer(), peer_);
}

void ViewerConnection::on_receive(std::string_view bytes) {
    state_.counters.bytes_received += bytes.size();
    const bool last =
        lws_is_final_fragment(connection_) != 0 && lws_remaining_packet_payload(connection_) == 0;
    session_.on_fragment(bytes, lws_is_first_fragment(connection_) != 0, last,
                         lws_frame_is_binary(connection_) != 0, server_time_ms());
    if (session_.held_until()) {
        set_timer();
    }
    watch_expiry();
    if (!slice_.take(bytes.size(), last)) {
        // libwebsockets keeps what it has read; the network thread wakes itself once the others
        // have been served.
        lws_rx_flow_control(connection_, 0);
        lws_cancel_service(lws_get_context(connection_));
    }
    poll_output();
}

void ViewerConnection::on_pong(std::string_view payload) {
    link_->on_pong(payload, server_time_ms());
}

void ViewerConnection::next_slice() {
    if (slice_.spent()) {
        lws_rx_flow_control(connection_, 1);
    }
    slice_.renew();
}

void ViewerConnection::check_pass() {
    session_.check_pass();
    poll_output();
}

void ViewerConnection::close(CloseCode code, std::string_view reason) {
    link_->close(code, std::string(reason));
    poll_output();
}

void ViewerConnection::poll_output() {
    if (link_->closing() && !close_timer_set_) {
        close_timer_set_ = true;
        lws_set_timer_usecs(connection_, microseconds(kCloseTimeoutS));
    }
    if (current_ || link_->has_output()) {
        lws_callback_on_writable(connection_);
    }
}

/// For what comes first: an answer that is held back, or the end of the time for hello.
void ViewerConnection::set_timer() {
    const double due_ms = session_.held_until().value_or(hello_deadline_ms_);
    lws_set_timer_usecs(connection_,
                        microseconds(std::max(due_ms - server_time_ms(), 1.0) / 1000.0));
}

/// A session ends with its token. Timers are no longer than a day.
void ViewerConnection::watch_expiry() {
    constexpr double day_s = 86400.0;
    const auto expires = session_.expires_s();
    if (!expires || expiry_timer_set_ || link_->closing()) {
        return;
    }
    expiry_timer_set_ = true;
    const double now =
        std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    lws_set_timer_usecs(connection_, microseconds(std::clamp(*expires - now, 0.001, day_s)));
}

bool ViewerConnection::on_timer() {
    if (link_->closing()) {
        return false;
    }
    if (session_.held_until()) {
        session_.release_held();
        set_timer();
    } else if (session_.has_joined()) {
        session_.check_pass();
        expiry_timer_set_ = false;
        watch_expiry();
    } else {
        session_.on_hello_timeout();
    }
    poll_output();
    return true;
}

bool ViewerConnection::on_writable() {
    if (!current_) {
        current_ = link_->take(server_time_ms());
        written_ = 0;
    }
    if (current_) {
        if (!write_piece()) {
            return false;
        }
    } else if (const auto request = link_->close_due()) {
        std::string reason = request->reason.substr(0, kMaxReasonBytes);
        lws_close_reason(connection_, static_cast<lws_close_status>(request->code),
                         reinterpret_cast<unsigned char*>(reason.data()), reason.size());
        return false;
    }
    poll_output();
    return true;
}

/// Writes one fragment. What lies before it has been sent already, so libwebsockets may use it as
/// room for the fragment's header.
bool ViewerConnection::write_piece() {
    auto& bytes = current_->bytes;
    const std::size_t payload = bytes.size() - Outgoing::kHeadroom;
    const std::size_t size = std::min(payload - written_, kPieceBytes);
    const bool last = written_ + size == payload;
    const int flags = write_flags(current_->kind, written_ == 0, last);
    const int count = lws_write(connection_, bytes.data() + Outgoing::kHeadroom + written_, size,
                                static_cast<lws_write_protocol>(flags));
    if (count < static_cast<int>(size)) {
        return false;
    }
    written_ += size;
    state_.counters.bytes_sent += size;
    if (last) {
        current_.reset();
    }
    return true;
}

}  // namespace raybundle
