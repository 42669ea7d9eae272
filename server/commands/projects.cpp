// SPDX-License-Identifier: Apache-2.0
#include "options/projects_file.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <filesystem>

#include "commands/command.h"
#include "journal/project_log.h"
#include "journal/state_folder.h"
#include "options/log_settings.h"
#include "options/serve_settings.h"
#include "projects/front.h"

namespace raybundle {
namespace {

constexpr std::uint64_t bytes_per_megabyte = 1'000'000;

/// Given, or in the user's folder of state.
std::string state_folder(const Options& front) {
    if (!front.projects.state.empty()) {
        return std::filesystem::absolute(front.projects.state).string();
    }
    try {
        return StateFolder::of_user().path() / "projects";
    } catch (const JournalError& error) {
        throw UsageError(std::string("needs --state: ") + error.what());
    }
}

/// Throws UsageError where a project would let strangers in, as `serve` would.
void check_exposure(const ProjectEntry& project, const Options& front) {
    Options serve = project.serve;
    serve.network.listen = front.network.listen;
    serve.network.allow_remote = front.network.allow_remote;
    try {
        static_cast<void>(server_settings(serve));
    } catch (const UsageError& error) {
        throw UsageError("project " + project.name + ": " + error.what());
    }
}

ProjectSettings project_settings(const ProjectEntry& project, const Options& front,
                                 const std::string& folder, const std::string& token) {
    if (!is_project_name(project.name)) {
        throw UsageError("'" + project.name +
                         "' cannot be the name of a project: at most 64 letters, digits, -, _, .");
    }
    check_exposure(project, front);
    const NetworkOptions& network = project.serve.network;
    const bool secret = !network.tokens.empty() || network.jwt.has_value();
    const AccessToken watch{"front of the projects", v1::VIEWER, token_digest(token)};
    ProjectSettings settings;
    settings.name = project.name;
    settings.title = project.title;
    settings.scene = project.serve.scene.file;
    settings.config =
        server_config(project, front, folder + "/" + project.name, secret ? &watch : nullptr);
    settings.token = secret ? token : "";
    settings.max_memory_bytes =
        static_cast<std::uint64_t>(project.memory_megabytes) * bytes_per_megabyte;
    settings.max_connections = static_cast<std::size_t>(network.max_connections);
    settings.max_viewers = static_cast<std::size_t>(project.serve.serve.max_viewers);
    return settings;
}

/// token: by which the front looks after servers that have tokens.
FrontSettings front_settings(const ProjectsConfig& config, const std::string& token) {
    const Options& front = config.front;
    const auto [host, port] = parse_address(front.network.listen);
    FrontSettings settings;
    settings.host = host;
    settings.port = port;
    settings.state_folder = state_folder(front);
    settings.sleep_after_s = front.projects.sleep_after_s;
    settings.max_memory_bytes =
        static_cast<std::uint64_t>(front.projects.memory_megabytes) * bytes_per_megabyte;
    settings.max_connections = static_cast<std::size_t>(front.network.max_connections);
    settings.max_connections_per_address =
        static_cast<std::size_t>(front.network.max_connections_per_address);
    settings.tokens = AccessTokens(front.network.tokens);
    for (const ProjectEntry& project : config.projects) {
        settings.projects.push_back(project_settings(project, front, settings.state_folder, token));
    }
    return settings;
}

}  // namespace

int run_projects(const Options& options) {
    const std::string token = random_token();
    const ProjectsConfig config = read_projects(options);
    set_log(config.front);
    Front front(front_settings(config, token));
    fmt::print("raybundle serves {} projects at {}\n", config.projects.size(), front.address());
    std::fflush(stdout);
    front.run([&] {
        const ProjectsConfig fresh = read_projects(options);
        set_log_level(fresh.front);
        return front_settings(fresh, token);
    });
    return exit_done;
}

}  // namespace raybundle
