// SPDX-License-Identifier: Apache-2.0
#include "net/wire_codec.h"

#include <google/protobuf/stubs/logging.h>
#include <google/protobuf/util/json_util.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cctype>

#include "net/json_scan.h"
#include "net/message_validation.h"

namespace raybundle {
namespace {

namespace json_util = google::protobuf::util;

constexpr std::size_t kMaxQuoted = 160;  ///< bytes of foreign text repeated in an error

/// Protobuf complains about foreign bytes on stderr, where any client could fill the log.
void log_quietly(google::protobuf::LogLevel /*level*/, const char* /*file*/, int /*line*/,
                 const std::string& text) {
    spdlog::debug("protobuf: {}", text);
}

/// First line of `text`, cut between two UTF-8 characters.
std::string excerpt(std::string_view text) {
    text = text.substr(0, text.find('\n'));
    if (text.size() > kMaxQuoted) {
        std::size_t end = kMaxQuoted;
        while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {
            --end;
        }
        text = text.substr(0, end);
    }
    return std::string(text);
}

/// Protobuf's "(set_camera.eye.x): reason" in the names that the client uses: "setCamera.eye.x:
/// reason"; nothing before the reason where no field is named.
std::string client_words(const std::string& text) {
    constexpr std::string_view kNoField = ": ";
    if (text.starts_with(kNoField)) {
        return text.substr(kNoField.size());
    }
    const std::size_t end = text.find("): ");
    if (!text.starts_with('(') || end == std::string::npos) {
        return text;
    }
    std::string words;
    for (std::size_t i = 1; i < end; ++i) {
        const bool joint = text[i] == '_' && i + 1 < end;
        words += joint ? static_cast<char>(std::toupper(static_cast<unsigned char>(text[++i])))
                       : text[i];
    }
    return words + text.substr(end + 1);
}

std::optional<Refusal> check_size(std::size_t bytes, const WireLimits& limits) {
    if (bytes <= limits.max_message_bytes) {
        return std::nullopt;
    }
    return Refusal{
        v1::Error::RESOURCE_EXHAUSTED,
        "the message is larger than " + std::to_string(limits.max_message_bytes) + " bytes",
        std::nullopt};
}

std::optional<std::uint32_t> id_of(const v1::ClientMessage& message) {
    return message.has_id() ? std::optional(message.id()) : std::nullopt;
}

/// Known body or not, the message is well-formed: decides what to say about it.
ParsedMessage accept(v1::ClientMessage message, const std::string& unknown_body,
                     const WireLimits& limits) {
    if (message.body_case() == v1::ClientMessage::BODY_NOT_SET) {
        if (unknown_body.empty()) {
            return Refusal{v1::Error::INVALID_ARGUMENT, "the message says nothing", id_of(message)};
        }
        return Refusal{v1::Error::UNIMPLEMENTED, "unknown message " + unknown_body, id_of(message)};
    }
    if (auto refusal = validate(message, limits)) {
        refusal->id = id_of(message);
        return *refusal;
    }
    return message;
}

/// The top-level key that is no field of ClientMessage, quoted; empty where there is none.
std::string unknown_key(const std::vector<std::string>& keys) {
    const auto* const type = v1::ClientMessage::descriptor();
    const auto unknown = std::find_if(keys.begin(), keys.end(), [&](const std::string& key) {
        return type->FindFieldByCamelcaseName(key) == nullptr &&
               type->FindFieldByName(key) == nullptr;
    });
    if (unknown == keys.end()) {
        return {};
    }
    return std::string("\"").append(excerpt(*unknown)).append("\"");
}

template <typename Message>
std::string print(const Message& message) {
    json_util::JsonPrintOptions options;
    options.always_print_primitive_fields = true;
    std::string text;
    const auto status = json_util::MessageToJsonString(message, &text, options);
    if (!status.ok()) {
        spdlog::error("cannot write a {} as JSON: {}", message.GetTypeName(), status.ToString());
        return {};
    }
    return text;
}

}  // namespace

ParsedMessage parse_text_message(std::string_view text, const WireLimits& limits) {
    if (auto too_large = check_size(text.size(), limits)) {
        return *too_large;
    }
    const JsonScan scan = scan_json(text, limits.max_json_depth);
    if (!scan.error.empty()) {
        return Refusal{v1::Error::INVALID_ARGUMENT, scan.error, scan.id};
    }
    v1::ClientMessage message;
    json_util::JsonParseOptions options;
    options.ignore_unknown_fields = true;
    const auto status =
        json_util::JsonStringToMessage({text.data(), text.size()}, &message, options);
    if (!status.ok()) {
        return Refusal{v1::Error::INVALID_ARGUMENT,
                       client_words(excerpt({status.message().data(), status.message().size()})),
                       scan.id};
    }
    return accept(std::move(message), unknown_key(scan.keys), limits);
}

ParsedMessage parse_binary_message(std::string_view bytes, const WireLimits& limits) {
    if (auto too_large = check_size(bytes.size(), limits)) {
        return *too_large;
    }
    static google::protobuf::LogHandler* const before =
        google::protobuf::SetLogHandler(&log_quietly);
    static_cast<void>(before);
    v1::ClientMessage message;
    if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
        return Refusal{v1::Error::INVALID_ARGUMENT, "not a valid protobuf ClientMessage",
                       id_of(message)};
    }
    const auto& unknown = message.GetReflection()->GetUnknownFields(message);
    std::string unknown_body;
    if (!unknown.empty()) {
        unknown_body = "in field " + std::to_string(unknown.field(0).number());
    }
    return accept(std::move(message), unknown_body, limits);
}

std::string to_json(const v1::ServerMessage& message) {
    return print(message);
}

std::string to_json(const v1::FrameHeader& header) {
    return print(header);
}

v1::ServerMessage to_message(const Refusal& refusal) {
    v1::ServerMessage message;
    if (refusal.id) {
        message.set_reply_to(*refusal.id);
    }
    message.mutable_error()->set_code(refusal.code);
    message.mutable_error()->set_message(refusal.text);
    return message;
}

std::vector<std::uint8_t> frame_message(const v1::FrameHeader& header,
                                        std::span<const std::uint8_t> image, std::size_t headroom) {
    const std::string json = to_json(header);
    const auto length = static_cast<std::uint32_t>(json.size());
    std::vector<std::uint8_t> message(headroom);
    message.reserve(headroom + sizeof length + json.size() + image.size());
    for (unsigned shift = 0; shift < 32; shift += 8) {
        message.push_back(static_cast<std::uint8_t>(length >> shift));
    }
    message.insert(message.end(), json.begin(), json.end());
    message.insert(message.end(), image.begin(), image.end());
    return message;
}

}  // namespace raybundle
