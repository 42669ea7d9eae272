// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>

#include "projects/project.h"

namespace raybundle {

/// All projects, which share the memory of the machine: where it is short, the one that has been
/// asleep for longest ends, and starts anew from its journal when somebody comes.
class Projects {
  public:
    using Table = std::map<std::string, std::shared_ptr<Project>, std::less<>>;

    /// Throws std::runtime_error where a folder cannot be made.
    explicit Projects(const FrontSettings& settings) { set_settings(settings); }

    /// Takes new settings: projects come, change and go.
    void set_settings(const FrontSettings& settings);

    /// Null where there is none of that name.
    [[nodiscard]] std::shared_ptr<Project> find(std::string_view name) const;
    [[nodiscard]] const Table& all() const { return table_; }
    [[nodiscard]] ProcessUsage usage_of(const std::string& name) const;

    void add_to(PollSet& set);
    void step(const PollSet& set, FrontTime now);
    [[nodiscard]] bool in_between() const;
    void end_all(FrontTime now);
    [[nodiscard]] bool any_runs() const;

  private:
    void measure(FrontTime now);
    void start_wanted(FrontTime now);
    bool make_room(FrontTime now);
    [[nodiscard]] std::uint64_t used_bytes() const;

    Table table_;
    std::map<std::string, std::shared_ptr<Project>> leaving_;  ///< not in the settings any more
    std::map<std::string, ProcessUsage> usage_;
    std::uint64_t max_memory_bytes_ = 0;
    FrontTime measured_;
    bool stopping_ = false;
};

}  // namespace raybundle
