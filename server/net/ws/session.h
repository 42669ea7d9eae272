// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "net/access/gate.h"
#include "net/access/token_bucket.h"
#include "net/audit/audit_log.h"
#include "net/ws/inbox.h"
#include "net/ws/protocol_version.h"
#include "net/ws/viewer_link.h"
#include "net/ws/wire_codec.h"

namespace raybundle {

/// The receiving side of one viewer: puts fragments together, insists on a hello in a version
/// spoken here that passes the gate, refuses what the viewer's role does not allow, answers pings,
/// hands acknowledgements to the pacing and everything else to the inbox. Runs on the network
/// thread but knows no socket.
class Session {
  public:
    Session(ViewerLink& link, Inbox& inbox, Gate& gate, const WireLimits& limits,
            double messages_per_second, std::string peer = "unknown", AuditLog* audit = nullptr)
        : link_(link),
          inbox_(inbox),
          gate_(gate),
          limits_(limits),
          messages_(messages_per_second, 2.0 * messages_per_second),
          complaints_(1.0, 1.0),
          peer_(std::move(peer)),
          audit_(audit) {}

    /// Part of a WebSocket message, as it arrives.
    void on_fragment(std::string_view bytes, bool first, bool last, bool binary, double now_ms);

    /// When the answer to a wrong token is due, clock of `now_ms`; nothing where none is held back.
    /// What comes before it is not read.
    [[nodiscard]] std::optional<double> held_until() const;
    /// Sends it.
    void release_held();

    /// When its token expires, Unix time in s; nothing where it does not.
    [[nodiscard]] std::optional<double> expires_s() const {
        return pass_ ? pass_->expires_s : std::nullopt;
    }

    /// Time for hello is over: closes if there was none.
    void on_hello_timeout();

    /// The connection is gone.
    void on_closed();

    /// The gate has other tokens now, or this one expires: closes if it would not be accepted
    /// again.
    void check_pass();

    [[nodiscard]] bool has_joined() const { return pass_.has_value(); }

  private:
    void on_message(v1::ClientMessage message, double now_ms);
    void on_hello(v1::ClientMessage message, double now_ms);
    [[nodiscard]] bool speaks_our_version(const v1::ClientMessage& message);
    void on_denied(const Denial& denial, bool wrong_token, double now_ms);
    void answer_ok(std::uint32_t id);
    void refuse(const Refusal& refusal);
    void refuse_and_close(const Refusal& refusal, CloseCode code);

    ViewerLink& link_;
    Inbox& inbox_;
    Gate& gate_;
    const WireLimits limits_;
    TokenBucket messages_;
    TokenBucket complaints_;  ///< about too many messages, one a second
    std::string buffer_;      ///< the message so far, at most limits_.max_message_bytes
    bool binary_ = false;
    Reading reading_ = Reading::lenient;  ///< until hello says how: anything else is refused anyway
    bool light_ = false;                  ///< hello has asked for it
    std::optional<Pass> pass_;            ///< once hello has been accepted
    int wrong_tokens_ = 0;
    std::string peer_;  ///< for the log
    AuditLog* audit_;   ///< null: there is none
    struct Held {
        Denial denial;
        double until_ms = 0.0;
    };
    std::optional<Held> held_;
};

}  // namespace raybundle
