// SPDX-License-Identifier: Apache-2.0
#include "projects/project_watch.h"

#include <nlohmann/json.hpp>

namespace raybundle {
namespace {

constexpr auto between_questions = std::chrono::seconds(2);
constexpr auto answer_time = std::chrono::seconds(10);

}  // namespace

void ProjectWatch::add_to(PollSet& set) {
    for (auto* request : {&figures_request_, &people_request_}) {
        if (*request) {
            (*request)->add_to(set);
        }
    }
}

void ProjectWatch::step(const PollSet& set, FrontTime now, std::uint16_t port,
                        const std::string& token) {
    for (auto* request : {&figures_request_, &people_request_}) {
        if (*request) {
            (*request)->step(set, now);
        }
    }
    if (figures_request_ && figures_request_->done()) {
        figures_ = figures_request_->status() == 200 ? figures_request_->body() : "";
        figures_request_.reset();
    }
    if (people_request_ && people_request_->done()) {
        take_people(people_request_->status() == 200 ? people_request_->body() : "");
        people_request_.reset();
    }
    if (port != 0 && !figures_request_ && !people_request_ && now - last_ >= between_questions) {
        last_ = now;
        figures_request_.emplace(port, ChildRequest::Question{"GET", "/metrics", token},
                                 now + answer_time);
        people_request_.emplace(port, ChildRequest::Question{"GET", "/api/v1/viewers", token},
                                now + answer_time);
    }
}

void ProjectWatch::take_people(const std::string& presence) {
    people_.clear();
    const nlohmann::json told = nlohmann::json::parse(presence, nullptr, false);
    if (!told.is_object() || !told.contains("viewers") || !told["viewers"].is_array()) {
        return;
    }
    for (const nlohmann::json& viewer : told["viewers"]) {
        people_.push_back(viewer.value("name", ""));
    }
}

void ProjectWatch::forget() {
    figures_request_.reset();
    people_request_.reset();
    figures_.clear();
    people_.clear();
    last_ = {};
}

}  // namespace raybundle
