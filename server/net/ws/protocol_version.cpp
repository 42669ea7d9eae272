// SPDX-License-Identifier: Apache-2.0
#include "net/ws/protocol_version.h"

#include <charconv>

namespace raybundle {

std::optional<ProtocolVersion> parse_protocol_version(std::string_view text) {
    ProtocolVersion version;
    const char* const end = text.data() + text.size();
    const auto [dot, major_error] = std::from_chars(text.data(), end, version.major);
    if (major_error != std::errc() || dot == end || *dot != '.') {
        return std::nullopt;
    }
    const auto [rest, minor_error] = std::from_chars(dot + 1, end, version.minor);
    if (minor_error != std::errc() || rest != end || version.major < 0 || version.minor < 0) {
        return std::nullopt;
    }
    return version;
}

ProtocolVersion own_protocol_version() {
    return parse_protocol_version(kProtocolVersion).value();
}

}  // namespace raybundle
