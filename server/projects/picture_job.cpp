// SPDX-License-Identifier: Apache-2.0
#include "projects/picture_job.h"

#include <nlohmann/json.hpp>

namespace raybundle {
namespace {

constexpr auto picture_time = std::chrono::seconds(120);
constexpr auto between_looks = std::chrono::milliseconds(300);
/// The fewest samples that a snapshot has: machines are slow where many projects are.
constexpr const char* question =
    R"({"snapshot":{"width":480,"height":270,"relativeError":1,"format":"PNG"}})";

}  // namespace

PictureJob::PictureJob(std::uint16_t port, std::string token, FrontTime now)
    : port_(port),
      token_(std::move(token)),
      until_(now + picture_time),
      ask_again_(FrontTime::max()) {
    ask("POST", "/api/v1/snapshots?name=projects", question);
}

void PictureJob::ask(const std::string& method, const std::string& target,
                     const std::string& body) {
    request_.emplace(port_, ChildRequest::Question{method, target, token_, body}, until_);
}

void PictureJob::step(const PollSet& set, FrontTime now) {
    if (done_) {
        return;
    }
    if (now > until_) {
        done_ = true;
    } else if (now >= ask_again_) {
        ask_again_ = FrontTime::max();
        ask("GET", asked_for_);
    } else if (!request_->done()) {
        request_->step(set, now);
        if (request_->done()) {
            take_answer(now);
        }
    }
}

/// 202: not yet; 200 with JSON: where the picture is; 200 with a picture: that.
void PictureJob::take_answer(FrontTime now) {
    const std::string& body = request_->body();
    const int status = request_->status();
    if (status == 200 && body.starts_with("\x89PNG")) {
        picture_ = body;
        done_ = true;
        return;
    }
    const nlohmann::json answer = nlohmann::json::parse(body, nullptr, false);
    const bool told = answer.is_object() && answer.contains("url") && answer["url"].is_string();
    if (!told || (status != 200 && status != 202)) {
        done_ = true;
        return;
    }
    asked_for_ = answer["url"].get<std::string>();
    ask_again_ = status == 200 ? now : now + between_looks;
}

}  // namespace raybundle
