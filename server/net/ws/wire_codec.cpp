// SPDX-License-Identifier: Apache-2.0
#include "net/ws/wire_codec.h"

#include <google/protobuf/stubs/logging.h>
#include <google/protobuf/util/json_util.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "net/ws/json_fields.h"
#include "net/ws/json_scan.h"
#include "net/ws/protocol_version.h"
#include "net/ws/rules/message_rules.h"

namespace raybundle {
namespace {

namespace json_util = google::protobuf::util;

/// Protobuf complains about foreign bytes on stderr, where any client could fill the log.
void log_quietly(google::protobuf::LogLevel /*level*/, const char* /*file*/, int /*line*/,
                 const std::string& text) {
    spdlog::debug("protobuf: {}", text);
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

/// What a message has that this server does not know.
struct Unknown {
    std::string body;  ///< empty, or what stands beside the known fields of the outermost object
    std::string part;  ///< empty, or "field: reason" of the first one further inside
};

/// Known body or not, the message is well-formed: decides what to say about it.
ParsedMessage accept(v1::ClientMessage message, const Unknown& unknown, Reading reading,
                     const WireLimits& limits) {
    if (message.body_case() == v1::ClientMessage::BODY_NOT_SET) {
        if (unknown.body.empty()) {
            return Refusal{v1::Error::INVALID_ARGUMENT, "the message says nothing", id_of(message)};
        }
        return Refusal{v1::Error::UNIMPLEMENTED, "unknown message " + unknown.body, id_of(message)};
    }
    if (message.has_hello()) {
        reading = reading_of(message.hello());
    }
    if (reading == Reading::strict && !(unknown.body.empty() && unknown.part.empty())) {
        return Refusal{v1::Error::INVALID_ARGUMENT,
                       unknown.part.empty() ? unknown.body + ": unknown field" : unknown.part,
                       id_of(message)};
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
    return std::string("\"").append(short_excerpt(*unknown)).append("\"");
}

/// `measure.grid` is the name of a rule, or an object of columns and rows. Proto3's JSON knows no
/// field that is either: the numbers become fields of `measure`. Other texts stay as they are.
std::string with_flat_grid(std::string_view text) {
    if (text.find("\"measure\"") == std::string_view::npos ||
        text.find("\"grid\"") == std::string_view::npos) {
        return std::string(text);
    }
    nlohmann::ordered_json message = nlohmann::ordered_json::parse(text, nullptr, false);
    if (!message.is_object() || !message.contains("measure") || !message["measure"].is_object()) {
        return std::string(text);
    }
    nlohmann::ordered_json& measure = message["measure"];
    if (!measure.contains("grid") || !measure["grid"].is_object()) {
        return std::string(text);
    }
    const nlohmann::ordered_json grid = measure["grid"];
    measure.erase("grid");
    measure.update(grid);  // what it has beside columns and rows is refused as a field of measure
    return message.dump();
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

Reading reading_of(const v1::Hello& hello) {
    const auto version = parse_protocol_version(hello.protocol());
    const bool newer = version && *version > own_protocol_version();
    return hello.lenient() || newer ? Reading::lenient : Reading::strict;
}

ParsedMessage parse_text_message(std::string_view sent, const WireLimits& limits, Reading reading) {
    if (auto too_large = check_size(sent.size(), limits)) {
        return *too_large;
    }
    const JsonScan scan = scan_json(sent, limits.max_json_depth);
    if (!scan.error.empty()) {
        return Refusal{v1::Error::INVALID_ARGUMENT, scan.error, scan.id};
    }
    const std::string text = with_flat_grid(sent);
    const JsonFields fields = check_json_fields(text, *v1::ClientMessage::descriptor());
    if (!fields.problem.empty()) {
        return Refusal{v1::Error::INVALID_ARGUMENT, fields.problem, scan.id};
    }
    v1::ClientMessage message;
    json_util::JsonParseOptions options;
    options.ignore_unknown_fields = true;
    const auto status = json_util::JsonStringToMessage(text, &message, options);
    if (!status.ok()) {
        spdlog::debug("protobuf: {}", status.ToString());
        return Refusal{v1::Error::INVALID_ARGUMENT,
                       fields.unknown.empty() ? "the message cannot be read" : fields.unknown,
                       scan.id};
    }
    Unknown unknown{unknown_key(scan.keys), fields.unknown};
    if (unknown.part.empty()) {
        unknown.part = unknown_in_binary(message);  // enum numbers
    }
    return accept(std::move(message), unknown, reading, limits);
}

ParsedMessage parse_binary_message(std::string_view bytes, const WireLimits& limits,
                                   Reading reading) {
    if (auto too_large = check_size(bytes.size(), limits)) {
        return *too_large;
    }
    static google::protobuf::LogHandler* const before =
        google::protobuf::SetLogHandler(&log_quietly);
    static_cast<void>(before);
    v1::ClientMessage message;
    if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
        return Refusal{v1::Error::INVALID_ARGUMENT, "not a valid serialised ClientMessage",
                       id_of(message)};
    }
    const auto& fields = message.GetReflection()->GetUnknownFields(message);
    Unknown unknown;
    if (!fields.empty()) {
        unknown.body = "in field " + std::to_string(fields.field(0).number());
    }
    unknown.part = unknown_in_binary(message);
    return accept(std::move(message), unknown, reading, limits);
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

namespace {

/// Headroom, length of a header, the header, and what belongs to it.
std::vector<std::uint8_t> binary_message(const std::string& json,
                                         std::span<const std::uint8_t> body, std::size_t headroom) {
    const auto length = static_cast<std::uint32_t>(json.size());
    std::vector<std::uint8_t> message(headroom);
    message.reserve(headroom + sizeof length + json.size() + body.size());
    for (unsigned shift = 0; shift < 32; shift += 8) {
        message.push_back(static_cast<std::uint8_t>(length >> shift));
    }
    message.insert(message.end(), json.begin(), json.end());
    message.insert(message.end(), body.begin(), body.end());
    return message;
}

}  // namespace

std::vector<std::uint8_t> frame_message(const v1::FrameHeader& header,
                                        std::span<const std::uint8_t> image, std::size_t headroom) {
    return binary_message(to_json(header), image, headroom);
}

std::vector<std::uint8_t> light_message(const v1::LightHeader& header, std::string_view blocks,
                                        std::size_t headroom) {
    const std::span body(reinterpret_cast<const std::uint8_t*>(blocks.data()), blocks.size());
    return binary_message(print(header), body, headroom);
}

}  // namespace raybundle
