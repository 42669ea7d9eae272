// SPDX-License-Identifier: Apache-2.0
#include "net/http/http_response.h"

#include <algorithm>
#include <array>

namespace raybundle {
namespace {

using NameValue = std::pair<const char*, std::string_view>;

constexpr std::array<NameValue, 6> kHeaders{{
    {"cache-control:", "no-cache"},
    {"content-security-policy:",
     "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
     "font-src 'self'; connect-src 'self'; worker-src 'self'; manifest-src 'self'; "
     "base-uri 'none'; form-action 'none'; frame-ancestors 'self'"},
    {"x-content-type-options:", "nosniff"},
    {"referrer-policy:", "no-referrer"},
    {"cross-origin-opener-policy:", "same-origin"},
    {"permissions-policy:", "camera=(), microphone=(), geolocation=()"},
}};

std::string_view content_type(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 10> kTypes{{
        {".html", "text/html; charset=utf-8"},
        {".js", "text/javascript; charset=utf-8"},
        {".css", "text/css; charset=utf-8"},
        {".json", "application/json"},
        {".svg", "image/svg+xml"},
        {".png", "image/png"},
        {".jpg", "image/jpeg"},
        {".ico", "image/x-icon"},
        {".woff2", "font/woff2"},
        {".exr", "image/x-exr"},
    }};
    for (const auto& [suffix, type] : kTypes) {
        if (name.ends_with(suffix)) {
            return type;
        }
    }
    return "application/octet-stream";
}

HttpResponse plain(int status, std::string text) {
    HttpResponse response;
    response.status = status;
    response.body = std::move(text);
    return response;
}

/// The file in the form that the request takes, or 304 where the client has it already.
HttpResponse encoded_response(HttpResponse response, const EmbeddedFile& file,
                              const EncodedFile& encoded, const HttpContent& content) {
    const bool packed = encoded.gzip && accepts_gzip(content.accept_encoding);
    const std::string packed_etag = gzip_etag(encoded.etag);
    response.headers.emplace_back("etag:", packed ? packed_etag : encoded.etag);
    response.headers.emplace_back("vary:", "Accept-Encoding");
    if (packed) {
        response.file = encoded.gzip;
    } else {
        response.body = file.contents;
    }
    if (names_etag(content.if_none_match, packed ? packed_etag : encoded.etag)) {
        response.status = 304;
        response.send_body = false;
    } else if (packed) {
        response.headers.emplace_back("content-encoding:", "gzip");
    }
    return response;
}

HttpResponse file_response(std::string_view path, const HttpContent& content) {
    const std::string_view name = path == "/" ? "index.html" : path.substr(1);
    const auto file = std::find_if(content.files.begin(), content.files.end(),
                                   [&](const EmbeddedFile& entry) { return entry.name == name; });
    if (file == content.files.end()) {
        return plain(404, "Not found\n");
    }
    HttpResponse response;
    response.content_type = content_type(name);
    const EncodedFile* const encoded =
        content.encoded != nullptr ? content.encoded->find(name) : nullptr;
    if (encoded == nullptr) {
        response.body = file->contents;
        return response;
    }
    return encoded_response(std::move(response), *file, *encoded, content);
}

HttpResponse snapshot_response(std::string_view path, const SnapshotStore& store) {
    HttpResponse response;
    response.file = store.find(path);
    if (!response.file) {
        return plain(404, "Not found, or not any more\n");
    }
    response.content_type = content_type(path);
    return response;
}

/// What lies under a hash of its contents never changes.
HttpResponse content_response(std::string_view path, const HttpContent& content) {
    const std::shared_ptr<const ContentFile> file = content.contents->find(path);
    if (!file) {
        return plain(404, "Not found, or not any more\n");
    }
    HttpResponse response;
    response.content_type = content_type(path);
    response.headers = {{"cache-control:", "private, max-age=31536000, immutable"},
                        {"vary:", "Accept-Encoding"}};
    const bool packed = file->gzip && accepts_gzip(content.accept_encoding);
    response.file = packed ? file->gzip : file->bytes;
    if (packed) {
        response.headers.emplace_back("content-encoding:", "gzip");
    }
    return response;
}

/// Live: the network answers. Ready: there are pictures. Editable: changes can be saved, too.
HttpResponse health(std::string_view path, const HttpContent& content) {
    if (path == "/healthz/live") {
        return plain(200, "live\n");
    }
    if (path != "/healthz" && path != "/healthz/ready" && path != "/healthz/editable") {
        return plain(404, "Not found; there are live, ready and editable\n");
    }
    if (!content.ready) {
        return plain(503, "starting\n");
    }
    if (path == "/healthz/editable") {
        return content.editable ? plain(200, "editable\n")
                                : plain(503, "read-only: changes cannot be saved, see the log\n");
    }
    return plain(200, "ok\n");
}

HttpResponse get(std::string_view path, const HttpContent& content) {
    if (!path.starts_with('/')) {
        return plain(400, "Bad request\n");
    }
    if (path == "/healthz" || path.starts_with("/healthz/")) {
        return health(path, content);
    }
    if (path == "/metrics" && !content.metrics_allowed) {
        return plain(401, "Needs the header Authorization: Bearer TOKEN\n");
    }
    if (path == "/metrics") {
        HttpResponse response = plain(200, content.metrics);
        response.content_type = "text/plain; version=0.0.4; charset=utf-8";
        return response;
    }
    if (path == "/photometry" && !content.known_caller) {
        return plain(401, "Needs the header Authorization: Bearer TOKEN\n");
    }
    if (path == "/photometry" && content.photometry) {
        HttpResponse response = plain(200, *content.photometry);
        response.content_type = content_type(".json");
        return response;
    }
    if (path.starts_with(SnapshotStore::kFolder) && content.snapshots != nullptr) {
        return snapshot_response(path, *content.snapshots);
    }
    if (path.starts_with(ContentStore::kFolder) && content.contents != nullptr) {
        return content_response(path, content);
    }
    if (path == "/ws") {
        return upgrade_required("This is a WebSocket address\n");
    }
    return file_response(path, content);
}

}  // namespace

HttpResponse upgrade_required(std::string text) {
    HttpResponse response = plain(426, std::move(text));
    response.headers = {{"upgrade:", "websocket"}, {"sec-websocket-version:", "13"}};
    return response;
}

HttpResponse http_response(HttpMethod method, std::string_view path, const HttpContent& content) {
    if (method != HttpMethod::get && method != HttpMethod::head) {
        return plain(405, "Only GET and HEAD\n");
    }
    HttpResponse response = get(path, content);
    response.send_body = response.send_body && method == HttpMethod::get;
    return response;
}

std::span<const std::pair<const char*, std::string_view>> http_headers() {
    return kHeaders;
}

std::vector<std::pair<std::string, std::string>> headers_of(const HttpResponse& response) {
    std::vector<std::pair<std::string, std::string>> headers = response.headers;
    const auto add = [&headers](const char* name, std::string_view value) {
        const bool own = std::any_of(headers.begin(), headers.end(),
                                     [name](const auto& header) { return header.first == name; });
        if (!own) {
            headers.emplace_back(name, value);
        }
    };
    for (const auto& [name, value] : http_headers()) {
        add(name, value);
    }
    if (response.status == 429 || response.status == 503) {
        add("retry-after:", "1");
    }
    if (response.status == 401) {
        add("www-authenticate:", "Bearer");
    }
    if (response.ends_connection) {
        add("connection:", "close");
    }
    return headers;
}

HttpResponse last_response(HttpResponse response) {
    response.ends_connection = true;
    return response;
}

}  // namespace raybundle
