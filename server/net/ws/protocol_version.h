// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <optional>
#include <string_view>

namespace raybundle {

/// "major.minor" of the protocol spoken here.
inline constexpr std::string_view kProtocolVersion = "1.0";

struct ProtocolVersion {
    int major = 0;
    int minor = 0;

    auto operator<=>(const ProtocolVersion&) const = default;
};

/// Nothing where the text is not "major.minor".
std::optional<ProtocolVersion> parse_protocol_version(std::string_view text);

/// Version of kProtocolVersion.
ProtocolVersion own_protocol_version();

}  // namespace raybundle
