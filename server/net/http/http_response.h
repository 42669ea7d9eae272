// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "embedded_file.h"
#include "net/http/content_store.h"
#include "net/http/encoded_files.h"
#include "net/http/snapshot_store.h"

namespace raybundle {

enum class HttpMethod { get, head, put, post, patch, remove, other };

/// Answer to one HTTP request; headers common to all answers are http_headers().
struct HttpResponse {
    int status = 200;
    std::string_view content_type = "text/plain; charset=utf-8";
    std::string body;
    std::shared_ptr<const std::string> file;  ///< body where it is not null, shared with its store
    bool send_body = true;  ///< false for HEAD and 304: the length is stated, the body is not sent
    /// Besides http_headers(), and in their place where the name is the same; names end with a
    /// colon.
    std::vector<std::pair<std::string, std::string>> headers;
    /// What comes behind its request is a body that nobody reads: too long, or of unknown length.
    bool ends_connection = false;

    [[nodiscard]] const std::string& content() const { return file ? *file : body; }
};

/// What answers depend on.
struct HttpContent {
    std::span<const EmbeddedFile> files;       ///< served by exact name, "/" as index.html
    bool ready = false;                        ///< of /healthz
    std::string metrics;                       ///< of /metrics
    bool metrics_allowed = true;               ///< the request has shown a token, or needs none
    const SnapshotStore* snapshots = nullptr;  ///< of /snapshots/...; null: there are none
    const EncodedFiles* encoded = nullptr;     ///< of `files`; null: they are sent as they are
    std::string accept_encoding{};             ///< header of the request
    std::string if_none_match{};               ///< header of the request
    bool editable = true;                      ///< of /healthz/editable
    const ContentStore* contents = nullptr;    ///< of /light/...; null: there are none
    bool known_caller = true;  ///< of /photometry: the request has shown a token, or needs none
    std::optional<std::string> photometry{};  ///< of /photometry; none: there are no such files
};

/// Decides about a request. `path` is the decoded path without query. Only names in the table are
/// ever served, so no path can lead out of it.
HttpResponse http_response(HttpMethod method, std::string_view path, const HttpContent& content);

/// 426 with the WebSocket version spoken here (RFC 6455, 4.4).
HttpResponse upgrade_required(std::string text);

/// Name and value of the headers of every answer: nothing is used from a cache unasked, strict
/// content security policy.
/// Names end with a colon, as libwebsockets wants them.
std::span<const std::pair<const char*, std::string_view>> http_headers();

/// All headers of an answer but its type and length. Besides http_headers() and its own ones:
/// where it may be asked for again (429, 503) and says no time, after a second; of 401 what is
/// needed; that the connection ends.
std::vector<std::pair<std::string, std::string>> headers_of(const HttpResponse& response);

/// An answer behind which the connection ends.
HttpResponse last_response(HttpResponse response);

}  // namespace raybundle
