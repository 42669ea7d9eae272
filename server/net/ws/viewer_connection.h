// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "net/network_state.h"
#include "net/ws/receive_slice.h"
#include "net/ws/session.h"

struct lws;

namespace raybundle {

/// One viewer's WebSocket connection: moves bytes between libwebsockets, the session (in) and the
/// link (out). Network thread only.
class ViewerConnection {
  public:
    /// peer: who is at the other end, for the log.
    ViewerConnection(lws* connection, NetworkState& state, std::string peer);
    ~ViewerConnection();
    ViewerConnection(const ViewerConnection&) = delete;
    ViewerConnection& operator=(const ViewerConnection&) = delete;

    void on_receive(std::string_view bytes);
    void on_pong(std::string_view payload);

    /// Writes the next piece of what waits. False: close the connection.
    bool on_writable();

    /// Time for hello, or for a close to be written, is over. False: close the connection.
    bool on_timer();

    /// Asks to be told when the connection can take output, if there is any.
    void poll_output();

    /// The others have had their turn: reads on where it has stopped.
    void next_slice();

    /// Closes if the viewer's token is no longer accepted.
    void check_pass();

    /// Closes once what waits is written.
    void close(CloseCode code, std::string_view reason);

    [[nodiscard]] const std::string& peer() const { return peer_; }

  private:
    bool write_piece();
    void set_timer();
    void watch_expiry();

    lws* connection_;
    NetworkState& state_;
    std::shared_ptr<ViewerLink> link_;
    Session session_;
    std::optional<Outgoing> current_;  ///< being written
    std::size_t written_ = 0;          ///< payload bytes of current_
    bool close_timer_set_ = false;
    bool expiry_timer_set_ = false;
    ReceiveSlice slice_;
    const std::string peer_;
    const double hello_deadline_ms_;
};

}  // namespace raybundle
