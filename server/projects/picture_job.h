// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "projects/child_request.h"

namespace raybundle {

/// Has a project's server take its picture for the list, as PNG. step() until done().
class PictureJob {
  public:
    PictureJob(std::uint16_t port, std::string token, FrontTime now);

    [[nodiscard]] bool done() const { return done_; }
    /// Empty where there is none.
    [[nodiscard]] const std::string& picture() const { return picture_; }

    void add_to(PollSet& set) { request_->add_to(set); }
    void step(const PollSet& set, FrontTime now);

  private:
    void ask(const std::string& method, const std::string& target, const std::string& body = {});
    void take_answer(FrontTime now);

    std::uint16_t port_;
    std::string token_;
    FrontTime until_, ask_again_;
    std::optional<ChildRequest> request_;
    std::string asked_for_;  ///< path of the request that makes it, then of the picture
    std::string picture_;
    bool done_ = false;
};

}  // namespace raybundle
