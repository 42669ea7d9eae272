// SPDX-License-Identifier: Apache-2.0
#include "net/rest/rest_messages.h"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>

#include "net/ws/json_fields.h"
#include "net/ws/json_scan.h"
#include "net/ws/protocol_version.h"

namespace raybundle {
namespace {

using Json = nlohmann::ordered_json;
using google::protobuf::FieldDescriptor;

constexpr std::string_view kRequestKey = "requestKey";

Refusal refusal(std::string text, v1::Error::Code code = v1::Error::INVALID_ARGUMENT) {
    return {code, std::move(text), std::nullopt};
}

std::string list_of(const std::vector<std::string_view>& names) {
    std::string list;
    for (const std::string_view name : names) {
        list += (list.empty() ? "" : ", ") + std::string(name);
    }
    return list;
}

/// A field of the path as a member of the message.
std::optional<Json> value_of(std::string_view message, const std::string& field,
                             const std::string& text) {
    const auto* const body =
        v1::ClientMessage::descriptor()->FindFieldByCamelcaseName(std::string(message));
    const auto* const type = body->message_type()->FindFieldByCamelcaseName(field);
    if (type->cpp_type() == FieldDescriptor::CPPTYPE_STRING) {
        return Json(text);
    }
    std::uint32_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && rest == end ? std::optional<Json>(number) : std::nullopt;
}

using Messages = std::vector<v1::ClientMessage>;

/// Reads one message as it would come over the socket, and appends it.
std::optional<Refusal> append(Json body, std::string_view name, const Json* key,
                              const WireLimits& limits, Messages& messages) {
    Json message;
    message["id"] = messages.size() + 1;
    if (key != nullptr) {
        message[std::string(kRequestKey)] = *key;
    }
    message[std::string(name)] = std::move(body);
    ParsedMessage parsed = parse_text_message(
        message.dump(-1, ' ', false, Json::error_handler_t::replace), limits, Reading::strict);
    if (auto* const problem = std::get_if<Refusal>(&parsed)) {
        return std::move(*problem);
    }
    messages.push_back(std::get<v1::ClientMessage>(std::move(parsed)));
    return std::nullopt;
}

/// The route's one message, of the body and of what stands in the path.
std::optional<Refusal> append_message(const RestMatch& match, Json body, const WireLimits& limits,
                                      Messages& messages) {
    const std::string_view name = match.route->messages.front();
    for (const auto& [field, text] : match.fields) {
        const auto value = value_of(name, field, text);
        if (!value) {
            return refusal("no " + field + " \"" + short_excerpt(text) + "\"",
                           v1::Error::NOT_FOUND);
        }
        if (body.contains(field)) {
            return refusal(std::string(name) + "." + field + ": stands in the path");
        }
        body[field] = *value;
    }
    return append(std::move(body), name, nullptr, limits, messages);
}

/// The messages that the body names.
std::optional<Refusal> append_named(const RestRoute& route, const Json& body,
                                    const WireLimits& limits, Messages& messages) {
    const auto& names = route.messages;
    for (const auto& [name, value] : body.items()) {
        if (name != kRequestKey && std::find(names.begin(), names.end(), name) == names.end()) {
            return refusal("\"" + short_excerpt(name) + "\": is not for this path; known are " +
                           list_of(names));
        }
    }
    const bool one = route.body == RestBody::one_of;
    const std::size_t keyed = body.contains(kRequestKey) ? 1 : 0;
    if (one && body.size() != keyed + 1) {
        return refusal("needs exactly one of " + list_of(names));
    }
    if (!one && (keyed != 0 || !body.contains(names.back()))) {
        return keyed != 0 ? refusal("requestKey: is for changes")
                          : refusal(std::string(names.back()) + ": is missing");
    }
    const Json* const key = keyed != 0 ? &body.at(std::string(kRequestKey)) : nullptr;
    for (const std::string_view name : names) {
        if (body.contains(name)) {
            if (auto problem = append(body.at(std::string(name)), name, key, limits, messages)) {
                return problem;
            }
        }
    }
    return std::nullopt;
}

/// Of a member that is given twice a tree knows one only: `twice` names the first such.
Json parse_noting_twice(std::string_view text, std::string& twice) {
    std::vector<std::set<std::string>> seen;
    return Json::parse(
        text,
        [&](int /*depth*/, Json::parse_event_t event, Json& parsed) {
            if (event == Json::parse_event_t::object_start) {
                seen.emplace_back();
            } else if (event == Json::parse_event_t::object_end) {
                seen.pop_back();
            } else if (event == Json::parse_event_t::key && twice.empty() &&
                       !seen.back().insert(parsed.get<std::string>()).second) {
                twice = parsed.get<std::string>();
            }
            return true;
        },
        false);
}

v1::ClientMessage hello() {
    v1::ClientMessage message;
    message.set_id(1);
    message.mutable_hello()->set_protocol(std::string(kProtocolVersion));
    return message;
}

/// The part of a message at "welcome.scene.lights"; null where it is absent.
const Json* part_at(const Json& message, std::string_view path) {
    const Json* part = &message;
    while (!path.empty()) {
        const std::size_t dot = path.find('.');
        const std::string name(path.substr(0, dot));
        if (!part->contains(name)) {
            return nullptr;
        }
        part = &part->at(name);
        path = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
    }
    return part;
}

/// A number or text of JSON as it stands in a path.
std::string text_of(const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

std::variant<Messages, Refusal> rest_messages(const RestMatch& match, std::string_view body,
                                              const WireLimits& limits) {
    const RestRoute& route = *match.route;
    if (!route.messages.empty() && route.messages.front() == "hello") {
        return Messages{hello()};
    }
    Json json = Json::object();
    if (route.body != RestBody::none) {
        // One level less: the message is around it.
        const JsonScan scan = scan_json(body, limits.max_json_depth - 1);
        if (!scan.error.empty()) {
            return refusal(body.empty() ? "needs a body, a JSON object"
                                        : "the body: " + scan.error);
        }
        std::string twice;
        json = parse_noting_twice(body, twice);
        if (!twice.empty()) {
            return refusal("\"" + short_excerpt(twice) + "\": is given twice");
        }
    }
    Messages messages;
    auto problem = route.body == RestBody::one_of || route.body == RestBody::sequence
                       ? append_named(route, json, limits, messages)
                       : append_message(match, std::move(json), limits, messages);
    if (problem) {
        return std::move(*problem);
    }
    return messages;
}

std::optional<std::string> rest_answer(const RestMatch& match, std::string_view message) {
    const RestRoute& route = *match.route;
    const Json json = Json::parse(message, nullptr, false);
    if (route.answers.size() > 1) {
        Json answer = Json::object();
        for (const std::string_view name : route.answers) {
            if (const Json* const part = part_at(json, name)) {
                answer[std::string(name)] = *part;
            }
        }
        return answer.dump();
    }
    const Json* const part = part_at(json, route.answers.front());
    if (part == nullptr) {
        return std::nullopt;
    }
    if (route.key.empty() || match.fields.empty()) {
        return part->dump();
    }
    const std::string& wanted = match.fields.front().second;
    const auto found = std::find_if(part->begin(), part->end(), [&](const Json& element) {
        return text_of(element.at(std::string(route.key))) == wanted;
    });
    return found == part->end() ? std::nullopt : std::optional(found->dump());
}

std::string location_of(const RestRoute& route, std::string_view answer) {
    const Json json = Json::parse(answer, nullptr, false);
    return std::string(route.path) + "/" + text_of(json.at(std::string(route.key)));
}

}  // namespace raybundle
