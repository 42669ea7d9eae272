// SPDX-License-Identifier: Apache-2.0
#include "net/rest/rest_call.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "net/clock.h"
#include "net/rest/rest_messages.h"
#include "net/rest/rest_problem.h"
#include "net/ws/json_fields.h"
#include "net/ws/protocol_version.h"
#include "net/ws/rules/message_rules.h"

namespace raybundle {
namespace {

using Json = nlohmann::ordered_json;

HttpResponse response_of(const RestMatch& match, std::string_view message) {
    auto answer = rest_answer(match, message);
    if (!answer) {
        return problem(v1::Error::NOT_FOUND, "no " + match.fields.front().first + " \"" +
                                                 short_excerpt(match.fields.front().second) + "\"");
    }
    HttpResponse response;
    response.status = match.route->status;
    response.content_type = "application/json";
    if (response.status == 201) {
        response.headers.emplace_back("location:", location_of(*match.route, *answer));
    }
    response.body = std::move(*answer) + "\n";
    return response;
}

HttpResponse response_of(const Json& error) {
    v1::Error::Code code = v1::Error::INTERNAL;
    v1::Error::Code_Parse(error.value("code", "INTERNAL"), &code);
    return problem(code, error.value("message", ""));
}

}  // namespace

RestCall::RestCall(NetworkState& state, RestMatch match, const Caller& caller,
                   std::vector<v1::ClientMessage> messages)
    : state_(state), match_(std::move(match)), last_id_(messages.back().id()) {
    for (const v1::ClientMessage& message : messages) {
        if (auto refusal = refuse_role(message, caller.role)) {
            if (state.settings.audit) {
                state.settings.audit->refuse(
                    {caller.name, caller.role, caller.token, caller.address}, message_name(message),
                    refusal->text);
            }
            answer_ = problem(refusal->code, std::move(refusal->text));
            return;
        }
    }
    link_ = state.viewers.add(state.settings.max_queued_bytes, state.settings.congestion);
    if (state.settings.audit) {
        state.settings.audit->enter(link_->viewer(),
                                    {caller.name, caller.role, caller.token, caller.address});
    }
    v1::ClientMessage hello;
    if (messages.front().has_hello()) {
        hello = std::move(messages.front());
        messages.clear();
    }
    hello.mutable_hello()->set_protocol(std::string(kProtocolVersion));
    hello.mutable_hello()->set_name(caller.name);
    state_.inbox.joined(link_->viewer(), std::move(hello), caller.role, true);
    for (v1::ClientMessage& message : messages) {
        static_cast<void>(
            state_.inbox.push(link_->viewer(), std::move(message), caller.role, true));
    }
}

RestCall::~RestCall() {
    leave();
}

void RestCall::leave() {
    if (link_) {
        state_.inbox.left(link_->viewer());
        if (state_.settings.audit) {
            state_.settings.audit->leave(link_->viewer());
        }
        state_.viewers.remove(link_->viewer());
        link_.reset();
    }
}

bool RestCall::listen() {
    while (link_ && !answer_) {
        const auto said = link_->take(server_time_ms());
        if (!said) {
            if (const auto close = link_->close_due()) {
                answer_ = problem(v1::Error::UNAVAILABLE, close->reason);
            }
            break;
        }
        if (said->kind == Outgoing::Kind::text) {
            hear({reinterpret_cast<const char*>(said->bytes.data()) + Outgoing::kHeadroom,
                  said->bytes.size() - Outgoing::kHeadroom});
        }
    }
    if (answer_) {
        leave();
    }
    return answer_.has_value();
}

void RestCall::hear(std::string_view text) {
    const Json message = Json::parse(text, nullptr, false);
    if (!message.is_object()) {
        return;
    }
    if (message.contains("error")) {
        answer_ = response_of(message["error"]);
    } else if (message.value("replyTo", 0U) == last_id_) {
        answer_ = response_of(match_, text);
    } else if (message.contains("snapshotProgress")) {
        progress_ = message["snapshotProgress"].dump();
    }
}

}  // namespace raybundle
