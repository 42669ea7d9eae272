// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "raybundle.pb.h"

namespace raybundle {

/// What a client message may be at most. No sockets here: tests and fuzzers drive this directly.
struct WireLimits {
    std::uint32_t max_message_bytes = 65536;
    int max_json_depth = 16;
    std::uint32_t max_viewport = 65535;  ///< edge that is understood, though served smaller, pixels
    std::uint32_t max_picture = 8192;    ///< edge of a snapshot, pixels
};

/// Why a message was not accepted, in the words the client gets.
struct Refusal {
    v1::Error::Code code = v1::Error::INVALID_ARGUMENT;
    std::string text;                 ///< field and reason
    std::optional<std::uint32_t> id;  ///< of the request, where it could be read
};

using ParsedMessage = std::variant<v1::ClientMessage, Refusal>;

/// What becomes of fields and enum values that the schema lacks: a misspelt one is refused, one of
/// a newer client is ignored.
enum class Reading { strict, lenient };

/// How a client wants its messages read: leniently where it says so, or speaks a newer version.
Reading reading_of(const v1::Hello& hello);

/// Parses and validates a text message: strict JSON (RFC 8259) of a ClientMessage. A hello is read
/// as it asks for itself.
ParsedMessage parse_text_message(std::string_view text, const WireLimits& limits = {},
                                 Reading reading = Reading::strict);

/// Parses and validates a binary message: serialised ClientMessage.
ParsedMessage parse_binary_message(std::string_view bytes, const WireLimits& limits = {},
                                   Reading reading = Reading::strict);

/// JSON of a message to a client, with every field that is not optional.
std::string to_json(const v1::ServerMessage& message);
std::string to_json(const v1::FrameHeader& header);

/// Error message for a refusal, with replyTo where the request had an id.
v1::ServerMessage to_message(const Refusal& refusal);

/// One frame on the wire: `headroom` bytes left free, u32 little-endian header length, header as
/// JSON, encoded image.
std::vector<std::uint8_t> frame_message(const v1::FrameHeader& header,
                                        std::span<const std::uint8_t> image,
                                        std::size_t headroom = 0);
/// The same of a message of light.
std::vector<std::uint8_t> light_message(const v1::LightHeader& header, std::string_view blocks,
                                        std::size_t headroom = 0);

}  // namespace raybundle
