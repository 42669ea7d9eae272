// SPDX-License-Identifier: Apache-2.0
// Requests over HTTP, "METHOD PATH", then the body from the next line on: whatever comes is either
// valid messages or a refusal that can be sent.
#include <nlohmann/json.hpp>

#include "fuzz_target.h"
#include "net/rest/rest_messages.h"
#include "net/rest/rest_problem.h"

namespace {

using namespace raybundle;

constexpr HttpMethod methods[] = {HttpMethod::get,  HttpMethod::head,  HttpMethod::put,
                                  HttpMethod::post, HttpMethod::patch, HttpMethod::remove};

void check_refusal(const Refusal& refusal) {
    FUZZ_REQUIRE(!refusal.text.empty() && refusal.text.size() < 1024);
    const HttpResponse response = problem(refusal.code, refusal.text);
    FUZZ_REQUIRE(response.status >= 400 && response.status < 500);
    FUZZ_REQUIRE(nlohmann::json::parse(response.body).at("status") == response.status);
}

void check_messages(const RestRoute& route, const std::vector<v1::ClientMessage>& messages) {
    FUZZ_REQUIRE(!messages.empty());
    for (const v1::ClientMessage& message : messages) {
        FUZZ_REQUIRE(message.body_case() != v1::ClientMessage::BODY_NOT_SET && message.has_id());
        FUZZ_REQUIRE(route.body == RestBody::one_of || !message.has_request_key());
        if (!message.has_hello()) {  // of which it is the caller that says the rest
            FUZZ_REQUIRE(std::holds_alternative<v1::ClientMessage>(
                parse_binary_message(message.SerializeAsString())));
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view input(reinterpret_cast<const char*>(data), size);
    const std::string_view line = input.substr(0, input.find('\n'));
    const std::string_view body = input.substr(std::min(input.size(), line.size() + 1));
    const std::size_t blank = std::min(line.find(' '), line.size());
    for (const HttpMethod method : methods) {
        if (method_name(method) != line.substr(0, blank)) {
            continue;
        }
        const RestMatch match = match_route(method, line.substr(std::min(line.size(), blank + 1)));
        if (match.route == nullptr || match.route->source != RestSource::session) {
            continue;
        }
        const auto messages = rest_messages(match, body, {});
        if (const auto* const refusal = std::get_if<Refusal>(&messages)) {
            check_refusal(*refusal);
        } else {
            check_messages(*match.route, std::get<std::vector<v1::ClientMessage>>(messages));
        }
    }
    return 0;
}
