// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "projects/child_request.h"

namespace raybundle {

/// What is known of a project's server while it is awake: its figures and who is there, asked for
/// every other second.
class ProjectWatch {
  public:
    /// port: of the server; 0: it sleeps, and is not asked.
    void step(const PollSet& set, FrontTime now, std::uint16_t port, const std::string& token);
    void add_to(PollSet& set);
    /// Nobody is there any more.
    void forget();

    [[nodiscard]] const std::vector<std::string>& people() const { return people_; }
    /// Its /metrics; empty where it sleeps.
    [[nodiscard]] const std::string& figures() const { return figures_; }

  private:
    void take_people(const std::string& presence);

    std::optional<ChildRequest> figures_request_, people_request_;
    FrontTime last_;
    std::string figures_;
    std::vector<std::string> people_;
};

}  // namespace raybundle
