// SPDX-License-Identifier: Apache-2.0
#include "telemetry/http_url.h"

#include <algorithm>
#include <charconv>

namespace raybundle {
namespace {

constexpr std::uint16_t http_port = 80;
constexpr std::uint16_t https_port = 443;
constexpr std::size_t max_letters = 2000;

std::optional<std::uint16_t> parse_port(std::string_view text) {
    unsigned port = 0;
    const char* const end = text.data() + text.size();
    const auto parsed = std::from_chars(text.data(), end, port);
    const bool fits = parsed.ec == std::errc() && parsed.ptr == end && port > 0 && port <= 65535;
    return fits ? std::optional(static_cast<std::uint16_t>(port)) : std::nullopt;
}

}  // namespace

std::optional<HttpUrl> parse_http_url(std::string_view text) {
    HttpUrl url;
    const auto skip = [&text](std::string_view scheme) {
        const bool has = text.starts_with(scheme);
        text.remove_prefix(has ? scheme.size() : 0);
        return has;
    };
    url.tls = skip("https://");
    const bool visible =
        std::all_of(text.begin(), text.end(), [](char c) { return c > ' ' && c <= '~'; });
    if ((!url.tls && !skip("http://")) || !visible || text.size() > max_letters) {
        return std::nullopt;
    }
    const std::size_t slash = text.find('/');
    std::string_view place = text.substr(0, slash);
    url.path = slash == std::string_view::npos ? "/" : std::string(text.substr(slash));
    url.port = url.tls ? https_port : http_port;
    const std::size_t bracket = place.starts_with('[') ? place.find(']') : 0;
    if (bracket == std::string_view::npos) {
        return std::nullopt;
    }
    if (const std::size_t colon = place.find(':', bracket); colon != std::string_view::npos) {
        const auto port = parse_port(place.substr(colon + 1));
        if (!port) {
            return std::nullopt;
        }
        url.port = *port;
        place = place.substr(0, colon);
    }
    url.host = bracket > 0 ? place.substr(1, bracket - 1) : place;
    const bool whole = bracket == 0 || place.size() == bracket + 1;
    const bool plain = place.find_first_of("@?#") == std::string_view::npos &&
                       url.path.find('#') == std::string::npos;
    return whole && plain && !url.host.empty() ? std::optional(url) : std::nullopt;
}

std::string HttpUrl::authority() const {
    const std::string name = host.find(':') == std::string::npos ? host : "[" + host + "]";
    return port == (tls ? https_port : http_port) ? name : name + ":" + std::to_string(port);
}

std::string HttpUrl::text() const {
    return (tls ? "https://" : "http://") + authority() + path;
}

}  // namespace raybundle
