// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "options/cli_options.h"

namespace raybundle {

/// A project, as `raybundle projects` is told of it.
struct ProjectEntry {
    std::string name;
    std::string title;  ///< for people
    int memory_megabytes = 0;
    Options serve;       ///< of its server, checked
    std::string config;  ///< the same as JSON, with the defaults for all, without title and memory
};

/// What `raybundle projects` serves, and how.
struct ProjectsConfig {
    Options front;  ///< network, log and projects
    std::vector<ProjectEntry> projects;
};

/// Reads the file that the options name, or all scenes of the folder, each a project by the name of
/// its file. The command line wins. Throws UsageError that names file, key and reason.
ProjectsConfig read_projects(const Options& options);

/// The configuration of a project's server: its own, on any free port of this machine, behind the
/// front. state: folder of the project; watch: entry of the token by which the front looks after
/// it, where it needs one.
std::string server_config(const ProjectEntry& project, const Options& front,
                          const std::string& state, const AccessToken* watch);

}  // namespace raybundle
