// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "net/access/gate.h"
#include "net/audit/audit_log.h"
#include "net/ws/wire_codec.h"
#include "stream/congestion_window.h"

namespace raybundle {

struct ServerSettings {
    std::string host = "127.0.0.1";  ///< name or numeric address to listen on
    std::uint16_t port = 8080;       ///< 0: any free port, see Server::port()
    std::string tls_certificate;     ///< PEM file; empty: no TLS
    std::string tls_key;             ///< PEM file
    std::size_t max_viewers = 64;
    std::size_t max_connections = 256;  ///< viewers and HTTP together
    /// Of one address; those of this machine are not limited, since a reverse proxy runs there.
    std::size_t max_connections_per_address = 32;
    bool limit_loopback = false;               ///< limits them too, for tests
    double hello_timeout_s = 5.0;              ///< to say hello
    std::size_t max_queued_bytes = 4U << 20U;  ///< messages waiting for one viewer, frames excepted
    double max_messages_per_second = 1000.0;   ///< of one viewer, on average
    std::uint32_t max_upload_bytes = 0;        ///< of PUT /scenes/NAME.glb; 0: no uploads
    double max_upload_s = 600.0;               ///< for the body of one
    std::size_t max_snapshot_bytes = 1U << 30U;  ///< of all snapshots that are kept
    std::vector<std::string> trusted_proxies;    ///< addresses whose X-Forwarded-For is believed
    Access access;
    std::shared_ptr<AuditLog> audit;  ///< null: there is none
    WireLimits limits;
    CongestionSettings congestion;
};

}  // namespace raybundle
