// SPDX-License-Identifier: Apache-2.0
#include "projects/project.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace raybundle {
namespace {

namespace fs = std::filesystem;

/// Until a new server listens; before it does it has no more to do than to load its libraries.
constexpr auto start_time = std::chrono::seconds(120);
/// Until a server that was asked to end is killed.
constexpr auto end_time = std::chrono::seconds(10);
/// A server that has been awake for so long has not failed again and again.
constexpr auto proven_time = std::chrono::seconds(60);
constexpr int most_doublings = 6;

std::string reason_of(int status) {
    switch (status) {
        case 2:
            return "its configuration is not accepted";
        case 3:
            return "its scene is not accepted";
        case 4:
            return "the graphics processor has failed";
        default:
            return status < 0 ? "its server was ended by signal " + std::to_string(-status)
                              : "its server has ended with status " + std::to_string(status);
    }
}

/// Only the user may read it: a configuration can hold passwords.
void write_private(const std::string& file, const std::string& bytes) {
    const std::string fresh = file + ".new";
    std::error_code problem;
    fs::remove(fresh, problem);
    std::ofstream stream(fresh, std::ios::binary);
    fs::permissions(fresh, fs::perms::owner_read | fs::perms::owner_write, problem);
    stream << bytes << std::flush;
    if (!stream || std::rename(fresh.c_str(), file.c_str()) != 0) {
        throw std::runtime_error(file + ": cannot be written");
    }
}

}  // namespace

std::string_view name_of(ProjectState state) {
    switch (state) {
        case ProjectState::off:
            return "OFF";
        case ProjectState::starting:
            return "STARTING";
        case ProjectState::awake:
            return "AWAKE";
        case ProjectState::asleep:
            return "ASLEEP";
        case ProjectState::ending:
            return "ENDING";
        default:
            return "FAILED";
    }
}

Project::Project(ProjectSettings settings, const std::string& folder, double sleep_after_s)
    : settings_(std::move(settings)), folder_(folder), sleep_after_(sleep_after_s) {
    std::error_code problem;
    fs::create_directories(folder_, problem);
    fs::permissions(folder_, fs::perms::owner_all, problem);
    if (problem) {
        throw std::runtime_error(folder_ + ": " + problem.message());
    }
    write_config();
    std::ifstream kept(file("picture.png"), std::ios::binary);
    picture_.assign(std::istreambuf_iterator<char>(kept), {});
}

void Project::write_config() const {
    write_private(file("serve.json"), settings_.config);
}

void Project::set_settings(ProjectSettings settings, double sleep_after_s) {
    sleep_after_ = std::chrono::duration<double>(sleep_after_s);
    const bool told = settings.config != settings_.config;
    settings_ = std::move(settings);
    if (told) {
        write_config();
    }
    if (told && server_) {
        server_->reload();
    }
}

void Project::arrive() {
    ++visits_;
    picture_is_old_ = true;
    picture_job_.reset();
}

void Project::leave(FrontTime now) {
    --visits_;
    since_ = state_ == ProjectState::awake ? now : since_;
}

std::optional<std::uint16_t> Project::visit() {
    if (state_ == ProjectState::awake) {
        return server_->port();
    }
    wanted_ = true;
    return std::nullopt;
}

std::string Project::problem(FrontTime now) const {
    return state_ == ProjectState::failed && now < failure_.again ? failure_.reason : "";
}

bool Project::wants_to_start(FrontTime now) const {
    return wanted_ && (state_ == ProjectState::off ||
                       (state_ == ProjectState::failed && now >= failure_.again));
}

bool Project::in_between() const {
    return wanted_ || state_ == ProjectState::starting || state_ == ProjectState::ending ||
           picture_job_.has_value();
}

void Project::set_state(ProjectState state, FrontTime now) {
    state_ = state;
    since_ = now;
    wanted_ = false;
    picture_job_.reset();
    watch_.forget();
    spdlog::info("{} is {}", settings_.name, name_of(state));
}

void Project::start(FrontTime now) {
    try {
        const std::string address = file("address");
        server_ = std::make_unique<ServerProcess>(
            settings_.name,
            std::vector<std::string>{"serve", "--config", file("serve.json"), "--address-file",
                                     address},
            address);
        ++starts_;
        set_state(ProjectState::starting, now);
    } catch (const std::exception& error) {
        fail(error.what(), now);
    }
}

void Project::refuse(FrontTime now) {
    wanted_ = false;
    state_ = ProjectState::failed;
    failure_.reason = "there is no memory for it as long as the others are looked at";
    failure_.again = now + std::chrono::seconds(2);
}

void Project::end(FrontTime now) {
    if (server_ && state_ != ProjectState::ending) {
        server_->end();
        set_state(ProjectState::ending, now);
    }
}

void Project::fail(const std::string& reason, FrontTime now) {
    failure_.without_scene = server_ && !server_->has_scene();
    server_.reset();
    failure_.reason = reason;
    failure_.again = now;
    if (failure_.times > 0) {
        failure_.again += std::chrono::seconds(1 << std::min(failure_.times, most_doublings));
    }
    ++failure_.times;
    set_state(ProjectState::failed, now);
    spdlog::error("{}: {}", settings_.name, reason);
}

void Project::note_end(int status, FrontTime now) {
    if (state_ == ProjectState::ending) {
        server_.reset();
        set_state(ProjectState::off, now);
    } else {
        fail(reason_of(status), now);
    }
}

void Project::check_memory(FrontTime now, std::uint64_t used_bytes) {
    if (settings_.max_memory_bytes > 0 && used_bytes > settings_.max_memory_bytes && server_ &&
        state_ != ProjectState::ending) {
        fail("it has used more memory than it may", now);
    }
}

void Project::add_to(PollSet& set) {
    if (server_) {
        server_->add_to(set);
    }
    watch_.add_to(set);
    if (picture_job_) {
        picture_job_->add_to(set);
    }
}

void Project::step(const PollSet& set, FrontTime now) {
    if (!server_) {
        return;
    }
    server_->step(set);
    if (const auto status = server_->ended()) {
        note_end(*status, now);
        return;
    }
    // Visitors see how far a new server is; where the last one had no scene they wait for that.
    const bool listens = server_->port() && (!failure_.without_scene || server_->has_scene());
    if (state_ == ProjectState::starting && listens) {
        set_state(ProjectState::awake, now);
    } else if (state_ == ProjectState::starting && !server_->port() && now - since_ > start_time) {
        fail("its server does not listen", now);
    } else if (state_ == ProjectState::ending && now - since_ > end_time) {
        server_->kill();
    } else if (state_ == ProjectState::asleep && wanted_) {
        server_->resume();
        set_state(ProjectState::awake, now);
    } else if (state_ == ProjectState::awake) {
        step_awake(set, now);
    }
}

void Project::step_awake(const PollSet& set, FrontTime now) {
    wanted_ = false;
    watch_.step(set, now, *server_->port(), settings_.token);
    if (visits_ > 0) {
        failure_.times = now - since_ > proven_time ? 0 : failure_.times;
        return;
    }
    if (picture_job_) {
        picture_job_->step(set, now);
        if (picture_job_->done()) {
            keep_picture(picture_job_->picture());
            fall_asleep(now);
        }
    } else if (now - since_ >= sleep_after_) {
        if (picture_is_old_) {
            picture_job_.emplace(*server_->port(), settings_.token, now);
        } else {
            fall_asleep(now);
        }
    }
}

void Project::fall_asleep(FrontTime now) {
    server_->pause();
    set_state(ProjectState::asleep, now);
}

void Project::keep_picture(const std::string& picture) {
    if (picture.empty()) {
        spdlog::warn("{}: no picture could be taken", settings_.name);
        return;
    }
    picture_ = picture;
    picture_is_old_ = false;
    try {
        write_private(file("picture.png"), picture);
    } catch (const std::runtime_error& error) {
        spdlog::warn("{}: {}", settings_.name, error.what());
    }
}

}  // namespace raybundle
