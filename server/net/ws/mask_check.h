// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <set>
#include <string_view>
#include <vector>

struct lws;

namespace raybundle {

/// Refuses viewers whose frames are not masked (RFC 6455, 5.1). libwebsockets hides the mask bit,
/// so this class looks at the first two bytes of a connection's first frame before libwebsockets
/// reads them: it holds reading back and lets libwebsockets watch a second descriptor of the
/// socket. A client masks all frames or none, so the first one decides. Network thread only.
class MaskCheck {
  public:
    /// Called with a connection that is to be closed (1002), and the reason in words.
    using Refuse = std::function<void(lws*, std::string_view)>;

    explicit MaskCheck(Refuse refuse) : refuse_(std::move(refuse)) {}

    /// The handshake of a connection has been answered.
    void add(lws* connection) { new_.insert(connection); }

    /// Something of the connection's has arrived: refuses one that sends in the same packet as its
    /// handshake, which 4.1 forbids, since nobody has seen the bytes of that frame.
    void on_receive(lws* connection);

    /// LWS_CALLBACK_RAW_RX_FILE of a watching descriptor. False: it has served.
    bool on_watch(lws* watch);

    /// After each round of lws_service(): begins to watch new connections, lets decided ones go on.
    void between_rounds();

    /// The connection is gone.
    void forget(lws* connection);

  private:
    enum class Verdict { unknown, masked, unmasked };

    static Verdict peek(lws* connection);
    void begin(lws* connection);
    void let_go(lws* connection, Verdict verdict);

    Refuse refuse_;
    std::set<lws*> new_;      ///< established in this round
    std::set<lws*> watched_;  ///< not read from
    std::set<lws*> decided_;  ///< in this round
};

}  // namespace raybundle
