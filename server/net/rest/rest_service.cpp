// SPDX-License-Identifier: Apache-2.0
#include "net/rest/rest_service.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "net/clock.h"
#include "net/rest/openapi.h"
#include "net/rest/rest_messages.h"
#include "net/rest/rest_problem.h"
#include "net/ws/rules/message_checker.h"

namespace raybundle {
namespace {

/// Value of a part of a query; empty where it is absent.
std::string query_value(std::string_view query, std::string_view name) {
    while (!query.empty()) {
        const std::size_t end = query.find('&');
        const std::string_view part = query.substr(0, end);
        if (part.starts_with(name) && part.substr(name.size()).starts_with('=')) {
            return std::string(part.substr(name.size() + 1));
        }
        query = end == std::string_view::npos ? std::string_view() : query.substr(end + 1);
    }
    return {};
}

/// Seconds, 0..most; nothing where the text says anything else.
std::optional<double> parse_wait(const std::string& text, double most) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    const bool number = *end == '\0' && std::isfinite(value);
    return number && value >= 0.0 && value <= most ? std::optional(value) : std::nullopt;
}

bool is_json(std::string_view content_type) {
    constexpr std::string_view json = "application/json";
    return content_type.starts_with(json) &&
           (content_type.size() == json.size() || content_type[json.size()] == ';' ||
            content_type[json.size()] == ' ');
}

HttpResponse stopping_problem() {
    return problem(v1::Error::UNAVAILABLE, "the server is stopping");
}

/// A trace that is none is ignored, as everywhere.
void note_trace(const std::string& traceparent, std::vector<v1::ClientMessage>& messages) {
    const bool fits = !traceparent.empty() && traceparent.size() <= kMaxTraceparent;
    for (v1::ClientMessage& message : messages) {
        if (fits) {
            message.set_traceparent(traceparent);
        }
    }
}

HttpResponse openapi_response() {
    HttpResponse response;
    response.content_type = "application/json";
    response.file = openapi_document();
    return response;
}

}  // namespace

/// Who asks, and whether it may. Nothing: it may.
std::optional<RestService::Outcome> RestService::examine_caller(const RestHead& head,
                                                                Running& running,
                                                                const std::string& name) {
    auto entered = state_.gate.admit(head.authorization, name);
    if (auto* const denial = std::get_if<Denial>(&entered)) {
        const bool wrong = denial->refusal.code == v1::Error::UNAUTHENTICATED;
        if (state_.settings.audit) {
            state_.settings.audit->refuse({name, std::nullopt, "", head.peer}, head.path,
                                          denial->refusal.text);
        }
        const double delay_ms =
            wrong && !head.authorization.empty()
                ? state_.gate.note_wrong_token(head.peer, head.path, server_time_ms())
                : 0.0;
        return Outcome{problem(denial->refusal.code, wrong ? "needs the header Authorization: "
                                                             "Bearer TOKEN"
                                                           : denial->refusal.text),
                       delay_ms};
    }
    const Pass& pass = std::get<Pass>(entered);
    running.caller.role = pass.role;
    running.caller.name = !pass.token_name.empty() ? pass.token_name : name;
    running.caller.token = pass.token_name;
    running.caller.address = head.peer;
    running.peer = pass.token_name.empty() ? head.peer : "token " + pass.token_name;
    return std::nullopt;
}

/// Who asks again for an answer has been named when it asked first. Who is here is asked for again
/// and again.
void RestService::audit(const RestHead& head, const Running& running) const {
    const RestCall::Caller& who = running.caller;
    const RestSource source = running.match.route->source;
    if (state_.settings.audit && source != RestSource::requests && source != RestSource::presence) {
        state_.settings.audit->request({who.name, who.role, who.token, who.address},
                                       std::string(method_name(head.method)) + " " + head.path);
    }
}

/// The refusal of what can be refused before the body is there, or an empty outcome.
RestService::Outcome RestService::examine(const RestHead& head, Running& running) {
    const auto refuse = [](int status, const std::string& text) {
        return Outcome{problem(status, text)};
    };
    if (!origin_allowed(head.origin, head.host, state_.gate.access()->origins)) {
        return refuse(403, "a page of another origin may not ask");
    }
    std::string name = query_value(head.query, "name");
    name = name.empty() ? "HTTP" : name;
    if (characters(name) > kMaxName) {
        return refuse(400, "name: must be at most 64 characters");
    }
    if (auto denied = examine_caller(head, running, name)) {
        return std::move(*denied);
    }
    running.match = match_route(head.method, head.path);
    if (running.match.route == nullptr) {
        if (running.match.allowed.empty()) {
            return refuse(404, "no such path; " + std::string(kOpenApiPath) + " lists all");
        }
        Outcome outcome = refuse(405, "here only " + running.match.allowed);
        outcome.response->headers.emplace_back("allow:", running.match.allowed);
        return outcome;
    }
    const std::string wait = query_value(head.query, "wait");
    const auto wait_s = wait.empty() ? running.match.route->wait_s : parse_wait(wait, most_wait_s);
    if (!wait_s) {
        return refuse(400, "wait: must be 0..30 seconds");
    }
    running.wait_s = *wait_s;
    audit(head, running);
    if (running.match.route->body != RestBody::none && running.has_body &&
        !is_json(head.content_type)) {
        return refuse(415, "Content-Type: must be application/json");
    }
    return {};
}

RestService::Outcome RestService::begin(lws* connection, RestHead head) {
    ++state_.counters.rest_requests;
    if (head.path == kOpenApiPath &&
        (head.method == HttpMethod::get || head.method == HttpMethod::head)) {
        return {openapi_response()};
    }
    const std::uint32_t most = state_.settings.limits.max_message_bytes;
    if (head.length && *head.length > most) {
        return {last_response(
            problem(413, "the body is larger than " + std::to_string(most) + " bytes"))};
    }
    // libwebsockets reads all that follows as the body where there is no length.
    const bool brings = head.method == HttpMethod::post || head.method == HttpMethod::put ||
                        head.method == HttpMethod::patch;
    if (head.chunked || (brings && !head.length)) {
        return {problem(411, "needs Content-Length")};
    }
    Running running;
    running.method = head.method;
    running.traceparent = head.traceparent;
    running.has_body = head.length.value_or(0) > 0;
    Outcome refused = examine(head, running);
    if (!running.has_body && refused.response) {
        return refused;
    }
    if (refused.response) {
        running.refused = std::move(refused);
    }
    const bool wait_for_body = running.has_body;
    running_.insert_or_assign(connection, std::move(running));
    return wait_for_body ? Outcome{std::nullopt, 0.0, body_s} : start(connection);
}

void RestService::write(lws* connection, std::string_view bytes) {
    Running& running = running_.at(connection);
    const std::size_t most = state_.settings.limits.max_message_bytes;
    running.body += bytes.substr(0, most - std::min(most, running.body.size()));
}

RestService::Outcome RestService::complete(lws* connection) {
    Running& running = running_.at(connection);
    if (!running.has_body || running.call) {
        return {std::nullopt, 0.0, running.wait_s};  // has been started without one
    }
    if (running.refused) {
        Outcome refused = std::move(*running.refused);
        running_.erase(connection);
        return refused;
    }
    return start(connection);
}

/// What was answered with 202 keeps nobody from looking.
std::optional<HttpResponse> RestService::refuse_crowd(const Running& asking) const {
    const bool looks = asking.match.route->method == HttpMethod::get;
    const std::string& peer = asking.peer;
    std::size_t all = looks ? 0 : requests_.running();
    std::size_t own = looks ? 0 : requests_.running(peer);
    for (const auto& [connection, other] : running_) {
        all += other.call ? 1 : 0;
        own += other.call && other.peer == peer ? 1 : 0;
    }
    if (own >= most_of_one) {
        return problem(v1::Error::RESOURCE_EXHAUSTED,
                       "this caller has " + std::to_string(most_of_one) + " requests running");
    }
    if (all >= most_running) {
        return problem(v1::Error::UNAVAILABLE,
                       "the server has " + std::to_string(most_running) + " requests running");
    }
    return std::nullopt;
}

/// Answers, or lets the session answer.
RestService::Outcome RestService::start(lws* connection) {
    Running& running = running_.at(connection);
    const auto answer = [&](HttpResponse response) {
        response.send_body = response.send_body && running.method != HttpMethod::head;
        running_.erase(connection);
        return Outcome{std::move(response)};
    };
    const RestRoute& route = *running.match.route;
    if (route.source == RestSource::photometry) {
        return answer(answer_photometry());
    }
    if (route.source == RestSource::presence) {
        HttpResponse response;
        response.content_type = "application/json";
        response.body = rest_answer(running.match, state_.presence()).value_or("{}") + "\n";
        return answer(std::move(response));
    }
    if (route.source == RestSource::requests) {
        return answer(answer_request(running));
    }
    if (stopping_) {
        return answer(stopping_problem());
    }
    auto messages = rest_messages(running.match, running.body, state_.settings.limits);
    if (auto* const refusal = std::get_if<Refusal>(&messages)) {
        return answer(problem(refusal->code, std::move(refusal->text)));
    }
    if (auto crowd = refuse_crowd(running)) {
        return answer(std::move(*crowd));
    }
    note_trace(running.traceparent, std::get<std::vector<v1::ClientMessage>>(messages));
    running.call = std::make_unique<RestCall>(state_, running.match, running.caller,
                                              std::get<std::vector<v1::ClientMessage>>(messages));
    if (running.call->listen()) {
        return answer(*running.call->answer());
    }
    if (running.wait_s <= 0.0) {
        return Outcome{expire(connection)};
    }
    return {std::nullopt, 0.0, running.wait_s};
}

HttpResponse RestService::answer_photometry() const {
    auto files = state_.photometry();
    if (!files) {
        return problem(v1::Error::NOT_FOUND, "this server has no photometric files");
    }
    HttpResponse response;
    response.content_type = "application/json";
    response.body = std::move(*files);
    return response;
}

HttpResponse RestService::answer_request(const Running& running) {
    const std::string& name = running.match.fields.front().second;
    return running.method == HttpMethod::remove ? requests_.drop(name) : requests_.look(name);
}

/// Who reads asks again; what has been asked for goes on.
std::optional<HttpResponse> RestService::expire(lws* connection) {
    auto late = running_.extract(connection);
    if (!late) {
        return std::nullopt;
    }
    Running& running = late.mapped();
    if (!running.call) {
        return last_response(problem(408, "the body did not come within 10 s"));
    }
    if (running.match.route->method == HttpMethod::get) {
        HttpResponse response = problem(v1::Error::UNAVAILABLE, "the server is busy");
        response.send_body = running.method != HttpMethod::head;
        return response;
    }
    return requests_.keep(std::move(running.call), std::move(running.peer));
}

std::vector<std::pair<lws*, HttpResponse>> RestService::finished() {
    requests_.listen();
    std::vector<std::pair<lws*, HttpResponse>> answers;
    for (auto entry = running_.begin(); entry != running_.end();) {
        Running& running = entry->second;
        const bool answered = running.call && running.call->listen();
        if (answered || (running.call && stopping_)) {
            HttpResponse response = answered ? *running.call->answer() : stopping_problem();
            response.send_body = running.method != HttpMethod::head;
            answers.emplace_back(entry->first, std::move(response));
            entry = running_.erase(entry);
        } else {
            ++entry;
        }
    }
    return answers;
}

}  // namespace raybundle
