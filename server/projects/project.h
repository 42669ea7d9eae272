// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "projects/picture_job.h"
#include "projects/project_settings.h"
#include "projects/project_watch.h"
#include "projects/server_process.h"

namespace raybundle {

enum class ProjectState {
    off,       ///< no process: nobody has come yet, or memory was short
    starting,  ///< until its server listens
    awake,
    asleep,  ///< stopped: it has its memory and its light, and gets no processor time
    ending,
    failed  ///< its server has ended by itself, or uses too much
};

/// "AWAKE" ...
std::string_view name_of(ProjectState state);

/// One project: its server, which runs while somebody is there. Everything of it happens in step(),
/// on the front's only thread.
class Project {
  public:
    /// folder: of its journal, its picture and what its server is told; is made where it is
    /// missing. Throws std::runtime_error.
    Project(ProjectSettings settings, const std::string& folder, double sleep_after_s);

    [[nodiscard]] const ProjectSettings& settings() const { return settings_; }
    /// Takes new settings; its server reads again what it can without a restart.
    void set_settings(ProjectSettings settings, double sleep_after_s);

    // Of visits, connections that lead to its server.
    [[nodiscard]] bool has_room() const { return visits_ < settings_.max_connections; }
    void arrive();
    void leave(FrontTime now);
    [[nodiscard]] std::size_t visits() const { return visits_; }
    /// The port of its server; nothing while that starts, which this call has it do.
    std::optional<std::uint16_t> visit();
    /// Why nobody can be let in for now; empty: somebody can.
    [[nodiscard]] std::string problem(FrontTime now) const;

    [[nodiscard]] ProjectState state() const { return state_; }
    [[nodiscard]] bool runs() const { return server_ != nullptr; }
    /// Its server is to start, for which it may need memory.
    [[nodiscard]] bool wants_to_start(FrontTime now) const;
    void start(FrontTime now);
    /// Has no memory to start with: who waits is sent away.
    void refuse(FrontTime now);
    /// Its server ends, asleep or not.
    void end(FrontTime now);
    [[nodiscard]] FrontTime asleep_since() const { return since_; }

    void add_to(PollSet& set);
    void step(const PollSet& set, FrontTime now);
    /// It waits for something that has no socket: starts, ends.
    [[nodiscard]] bool in_between() const;

    [[nodiscard]] ProcessUsage usage() const { return server_ ? server_->usage() : ProcessUsage{}; }
    void check_memory(FrontTime now, std::uint64_t used_bytes);
    [[nodiscard]] const ProjectWatch& watch() const { return watch_; }
    /// PNG; empty: none has been taken.
    [[nodiscard]] const std::string& picture() const { return picture_; }
    [[nodiscard]] std::uint64_t starts() const { return starts_; }

  private:
    void set_state(ProjectState state, FrontTime now);
    void note_end(int status, FrontTime now);
    void fail(const std::string& reason, FrontTime now);
    void step_awake(const PollSet& set, FrontTime now);
    void fall_asleep(FrontTime now);
    void keep_picture(const std::string& picture);
    void write_config() const;
    [[nodiscard]] std::string file(const std::string& name) const { return folder_ + "/" + name; }

    ProjectSettings settings_;
    std::string folder_;
    std::chrono::duration<double> sleep_after_;
    ProjectState state_ = ProjectState::off;
    FrontTime since_;  ///< of the state, or since the last visit has ended
    std::size_t visits_ = 0;
    bool wanted_ = false;
    std::unique_ptr<ServerProcess> server_;
    ProjectWatch watch_;
    std::optional<PictureJob> picture_job_;
    std::string picture_;
    bool picture_is_old_ = true;  ///< somebody has been there since it was taken
    /// Why and how often it has failed, one time after the other; when it may be tried again.
    struct Failure {
        std::string reason;
        int times = 0;
        bool without_scene = false;  ///< its server had not shown any
        FrontTime again;
    } failure_;
    std::uint64_t starts_ = 0;
};

}  // namespace raybundle
