// SPDX-License-Identifier: Apache-2.0
#include "net/rest/rest_requests.h"

#include <algorithm>
#include <utility>

#include "net/access/access_tokens.h"
#include "net/rest/rest_problem.h"
#include "net/rest/rest_route.h"

namespace raybundle {
namespace {

/// v1::RequestState. progress: JSON, or empty.
std::string state_json(std::string_view url, bool running, const RestRoute& route,
                       const std::string& progress) {
    std::string json = R"({"url":")" + std::string(url) + R"(","operation":")" +
                       std::string(route.operation) + R"(","running":)" +
                       (running ? "true" : "false");
    if (!progress.empty()) {
        json += R"(,"progress":)" + progress;
    }
    return json + "}\n";
}

std::string path_of(std::string_view name) {
    return std::string(kRestRequestsPath) + std::string(name);
}

HttpResponse accepted(std::string_view name, const RestCall& call) {
    HttpResponse response;
    response.status = 202;
    response.content_type = "application/json";
    response.body = state_json(path_of(name), true, call.route(), call.progress());
    response.headers = {{"location:", path_of(name)}, {"retry-after:", "1"}};
    return response;
}

HttpResponse unknown() {
    return problem(v1::Error::NOT_FOUND, "no such request, or not any more");
}

bool answered(const RestCall& call) {
    return call.answer() != nullptr;
}

}  // namespace

HttpResponse RestRequests::keep(std::unique_ptr<RestCall> call, std::string peer,
                                Clock::time_point now) {
    entries_.push_back({random_token(), std::move(peer), std::move(call), now});
    return accepted(entries_.back().name, *entries_.back().call);
}

std::list<RestRequests::Entry>::iterator RestRequests::find(std::string_view name) {
    return std::find_if(entries_.begin(), entries_.end(),
                        [name](const Entry& entry) { return entry.name == name; });
}

HttpResponse RestRequests::look(std::string_view name, Clock::time_point now) {
    listen(now);
    const auto found = find(name);
    if (found == entries_.end()) {
        return unknown();
    }
    found->asked = now;
    return answered(*found->call) ? *found->call->answer() : accepted(name, *found->call);
}

HttpResponse RestRequests::drop(std::string_view name) {
    const auto found = find(name);
    if (found == entries_.end()) {
        return unknown();
    }
    HttpResponse response;
    response.content_type = "application/json";
    response.body = state_json(path_of(name), false, found->call->route(), {});
    entries_.erase(found);
    return response;
}

void RestRequests::listen(Clock::time_point now) {
    std::erase_if(entries_, [now](const Entry& entry) { return now - entry.asked >= lifetime; });
    std::size_t answers = 0;
    for (const Entry& entry : entries_) {
        answers += entry.call->listen() ? 1 : 0;
    }
    for (auto entry = entries_.begin(); answers > most_answers;) {
        const bool old = answered(*entry->call);
        entry = old ? entries_.erase(entry) : std::next(entry);
        answers -= old ? 1 : 0;
    }
}

std::size_t RestRequests::running(std::string_view peer) const {
    return static_cast<std::size_t>(std::count_if(
        entries_.begin(), entries_.end(),
        [peer](const Entry& entry) { return entry.peer == peer && !answered(*entry.call); }));
}

std::size_t RestRequests::running() const {
    return static_cast<std::size_t>(
        std::count_if(entries_.begin(), entries_.end(),
                      [](const Entry& entry) { return !answered(*entry.call); }));
}

}  // namespace raybundle
