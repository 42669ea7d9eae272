// SPDX-License-Identifier: Apache-2.0
#include "projects/projects.h"

#include <spdlog/spdlog.h>

#include <algorithm>

namespace raybundle {
namespace {

constexpr auto between_measurements = std::chrono::seconds(1);

}  // namespace

void Projects::set_settings(const FrontSettings& settings) {
    max_memory_bytes_ = settings.max_memory_bytes;
    Table next;
    for (const ProjectSettings& project : settings.projects) {
        const auto known = table_.find(project.name);
        if (known == table_.end()) {
            next[project.name] = std::make_shared<Project>(
                project, settings.state_folder + "/" + project.name, settings.sleep_after_s);
        } else {
            known->second->set_settings(project, settings.sleep_after_s);
            next[project.name] = known->second;
        }
    }
    table_.swap(next);
    for (auto& [name, project] : next) {
        if (!table_.contains(name)) {
            leaving_.insert_or_assign(name, project);
        }
    }
}

std::shared_ptr<Project> Projects::find(std::string_view name) const {
    const auto found = table_.find(name);
    return found == table_.end() ? nullptr : found->second;
}

ProcessUsage Projects::usage_of(const std::string& name) const {
    const auto found = usage_.find(name);
    return found == usage_.end() ? ProcessUsage{} : found->second;
}

void Projects::add_to(PollSet& set) {
    for (const auto& [name, project] : table_) {
        project->add_to(set);
    }
    for (const auto& [name, project] : leaving_) {
        project->add_to(set);
    }
}

void Projects::step(const PollSet& set, FrontTime now) {
    for (const auto& [name, project] : table_) {
        project->step(set, now);
    }
    for (auto entry = leaving_.begin(); entry != leaving_.end();) {
        entry->second->end(now);
        entry->second->step(set, now);
        const ProjectState state = entry->second->state();
        const bool over = state == ProjectState::off || state == ProjectState::failed;
        entry = over ? leaving_.erase(entry) : std::next(entry);
    }
    if (now - measured_ >= between_measurements) {
        measure(now);
    }
    if (!stopping_) {
        start_wanted(now);
    }
}

void Projects::measure(FrontTime now) {
    measured_ = now;
    usage_.clear();
    for (const auto& [name, project] : table_) {
        usage_[name] = project->usage();
        project->check_memory(now, usage_[name].memory_bytes);
    }
    make_room(now);
}

std::uint64_t Projects::used_bytes() const {
    std::uint64_t sum = 0;
    for (const auto& [name, project] : table_) {
        // What has ended since the last measurement has given its memory back.
        sum += project->runs() ? usage_of(name).memory_bytes : 0;
    }
    return sum;
}

/// False where all memory that there may be is that of projects which are awake.
bool Projects::make_room(FrontTime now) {
    if (max_memory_bytes_ == 0 || used_bytes() <= max_memory_bytes_) {
        return true;
    }
    std::shared_ptr<Project> longest;
    bool ending = false;
    for (const auto& [name, project] : table_) {
        ending = ending || project->state() == ProjectState::ending;
        const bool asleep = project->state() == ProjectState::asleep;
        if (asleep && (!longest || project->asleep_since() < longest->asleep_since())) {
            longest = project;
        }
    }
    if (longest && !ending) {
        spdlog::info("{} is ended, since memory is short", longest->settings().name);
        longest->end(now);
    }
    return ending || longest != nullptr;
}

void Projects::start_wanted(FrontTime now) {
    for (const auto& [name, project] : table_) {
        if (!project->wants_to_start(now)) {
            continue;
        }
        if (max_memory_bytes_ == 0 || used_bytes() <= max_memory_bytes_) {
            project->start(now);
        } else if (!make_room(now)) {
            project->refuse(now);
        }
    }
}

bool Projects::in_between() const {
    return !leaving_.empty() || std::any_of(table_.begin(), table_.end(), [](const auto& entry) {
        return entry.second->in_between();
    });
}

void Projects::end_all(FrontTime now) {
    stopping_ = true;
    for (const auto& [name, project] : table_) {
        project->end(now);
    }
}

bool Projects::any_runs() const {
    return !leaving_.empty() || std::any_of(table_.begin(), table_.end(),
                                            [](const auto& entry) { return entry.second->runs(); });
}

}  // namespace raybundle
