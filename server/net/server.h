// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "net/http/content_store.h"
#include "net/http/document.h"
#include "net/http/upload.h"
#include "net/server_settings.h"
#include "net/ws/client_event.h"
#include "net/ws/inbox.h"
#include "net/ws/light_acks.h"

namespace raybundle {

/// Serves the client page, /healthz, /metrics and WebSocket viewers on a thread of its own.
/// All methods may be called from any thread; none waits for the network.
class Server {
  public:
    explicit Server(ServerSettings settings);
    ~Server();  ///< as stop()
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    /// Starts listening. Throws std::runtime_error that names the address where that fails.
    void start();

    /// Closes all connections (close code 1001) and ends the thread, within one second.
    void stop();

    [[nodiscard]] std::uint16_t port() const;   ///< that it listens on
    [[nodiscard]] std::string address() const;  ///< e.g. "http://127.0.0.1:8080"

    /// Events for the render thread.
    Inbox& inbox();

    /// Sends to one viewer; does nothing if it has left. A viewer that lets too many messages pile
    /// up is disconnected.
    void send(ViewerId viewer, const v1::ServerMessage& message);

    /// Sends to every viewer that has been welcomed, except one (0: none).
    void broadcast(const v1::ServerMessage& message, ViewerId except = 0);

    /// Answers a request: once for each of its ids, not at all if it has none.
    void reply(const ClientEvent& request, v1::ServerMessage answer);

    /// Answers a request that has no other answer.
    void reply_ok(const ClientEvent& request);

    /// Answers a request with an error, also if it has no id.
    void reply_error(const ClientEvent& request, v1::Error::Code code, const std::string& text);

    /// Sends an error, then closes the connection.
    void disconnect(ViewerId viewer, v1::Error::Code code, const std::string& text);

    /// Closes a connection once what waits for it is written.
    void close(ViewerId viewer, CloseCode code, const std::string& text);

    /// Closes every connection of a viewer; clients may come back at once.
    void close_all(CloseCode code, const std::string& text);

    /// Whether and how to send this viewer's next frame. Never `send` while a frame waits here.
    FrameAdvice advise(ViewerId viewer, const FrameDemand& demand);

    /// How long this viewer has left a frame unacknowledged, ms. A page that is hidden, a client
    /// that has hung and a link that has stalled look like this.
    [[nodiscard]] double silence_ms(ViewerId viewer) const;

    /// Whether this viewer has ever acknowledged a frame.
    [[nodiscard]] bool acknowledged(ViewerId viewer) const;

    /// Whether this viewer has answered the ping after its welcome, or acknowledged a frame.
    [[nodiscard]] bool answers(ViewerId viewer) const;

    /// Sends a frame. One frame waits at most: a newer one replaces it.
    void send_frame(ViewerId viewer, const v1::FrameHeader& header,
                    const std::vector<std::uint8_t>& image);

    /// Sends a message of light: blocks as LightMessage has them. The caller sees to it that few
    /// bytes are not acknowledged.
    void send_light(ViewerId viewer, const v1::LightHeader& header, std::string_view blocks);
    /// Whether light that is sent now is read soon; false also where there is no such viewer.
    [[nodiscard]] bool has_room_for_light(ViewerId viewer) const;

    /// Which messages of light have been acknowledged.
    LightAcks& light_acks();

    /// Serves files under a path that is a hash of them, e.g. "/light/9f...e1/"; the newest two
    /// folders of a kind stay. Takes long.
    std::string keep_content(std::string_view kind, ContentStore::Files files);

    /// Replaces tokens and origins. Viewers whose token is gone or means something else now are
    /// closed.
    void set_access(Access access);

    /// Null where there is none.
    [[nodiscard]] AuditLog* audit() const;

    /// Reads the certificate files of the settings again. Throws std::runtime_error that names the
    /// file where they cannot be used: the old certificate stays.
    void reload_certificate();

    void set_ready(bool ready);  ///< what /healthz says: 200 or 503

    /// Called on the network thread for GET /healthz/editable: whether changes can be saved.
    void set_editable_source(std::function<bool()> source);

    /// Takes the scene files that editors upload; called on the network thread. Without one, or
    /// with max_upload_bytes 0, there are no uploads.
    void set_upload_factory(UploadFactory factory);

    /// Called on the network thread for each GET /photometry; returns its JSON.
    void set_photometry_source(std::function<std::string()> source);
    /// Makes the documents that are asked for over HTTP; called on the network thread. An empty one
    /// takes away that of its owner alone.
    void set_document_source(const void* owner, DocumentSource source);

    /// Keeps a file for a quarter of an hour; the path under which the server has it, which nobody
    /// can guess. Nothing where it is larger than all that may be kept.
    std::optional<std::string> keep_snapshot(std::string bytes, std::string_view extension);

    /// Called on the network thread for each GET /metrics; returns more Prometheus text.
    void set_metrics_source(std::function<std::string()> source);

    /// Clock of Pong and FrameHeader: milliseconds since the program started.
    static double now_ms();

  private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace raybundle
