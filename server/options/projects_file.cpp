// SPDX-License-Identifier: Apache-2.0
#include "options/projects_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>

#include "options/config_file.h"
#include "options/config_json.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;
using Json = ConfigJson;

constexpr int front_connections = 1024;
constexpr int front_connections_per_address = 64;
constexpr std::size_t most_projects = 1000;
constexpr double most_megabytes = 1e9;
constexpr double most_seconds = 1e9;

/// Keys of `serve` that are of the front here.
constexpr std::array front_keys{
    "listen", "allowRemote", "trustedProxies", "maxConnections", "maxConnectionsPerAddress",
    "tokens", "logLevel",    "logFormat"};
/// What a project's server is told by the front.
constexpr std::array told_keys{"listen",      "allowRemote", "trustedProxies",
                               "addressFile", "tlsCert",     "tlsKey"};

bool is_one_of(std::string_view key, const auto& keys) {
    return std::find(keys.begin(), keys.end(), key) != keys.end();
}

double number(const std::string& where, const Json& value, double most) {
    if (!value.is_number() || value.get<double>() < 0.0 || value.get<double>() > most) {
        throw UsageError(fmt::format("{}: must be a number from 0 to {}", where, most));
    }
    return value.get<double>();
}

std::string text(const std::string& where, const Json& value) {
    if (!value.is_string()) {
        throw UsageError(where + ": must be a text");
    }
    return value.get<std::string>();
}

/// Where `where` is "FILE: projects.NAME".
ProjectEntry read_project(const std::string& where, const std::string& name, const Json& own,
                          const Json& defaults) {
    if (!own.is_object()) {
        throw UsageError(where + ": must be an object");
    }
    ProjectEntry project{name, name, 0, {}, {}};
    Json config = defaults;
    for (const auto& [key, value] : own.items()) {
        config[key] = value;
    }
    for (const char* key : told_keys) {
        if (config.contains(key)) {
            throw UsageError(fmt::format("{}: {}: is of all projects, not of one", where, key));
        }
    }
    if (config.contains("title")) {
        project.title = text(where + ": title", config["title"]);
    }
    if (config.contains("memoryMegabytes")) {
        project.memory_megabytes = static_cast<int>(
            number(where + ": memoryMegabytes", config["memoryMegabytes"], most_megabytes));
    }
    config.erase("title");
    config.erase("memoryMegabytes");
    project.config = config.dump();
    project.serve.command = Options::Command::serve;
    apply_config_text(where, project.config, project.serve);
    if (project.serve.scene.file.empty()) {
        throw UsageError(where + ": needs a scene");
    }
    return project;
}

void read_front(const std::string& file, const Json& json, const Options& options, Options& front) {
    Json shared = Json::object();
    for (const auto& [key, value] : json.items()) {
        const std::string where = file + ": " + key;
        const bool overridden = options.config.on_command_line.contains(key);
        if (is_one_of(key, front_keys)) {
            shared[key] = value;
        } else if (key == "state" && !overridden) {
            front.projects.state = text(where, value);
        } else if (key == "sleepAfterSeconds" && !overridden) {
            front.projects.sleep_after_s = number(where, value, most_seconds);
        } else if (key == "memoryMegabytes" && !overridden) {
            front.projects.memory_megabytes =
                static_cast<int>(number(where, value, most_megabytes));
        } else if (!is_one_of(key, std::array{"state", "sleepAfterSeconds", "memoryMegabytes",
                                              "defaults", "projects"})) {
            throw UsageError(where + ": unknown key");
        }
    }
    front.config.on_command_line = options.config.on_command_line;
    apply_config_text(file, shared.dump(), front);
}

ProjectsConfig read_file(const Options& options, ProjectsConfig config) {
    const std::string& file = options.projects.source;
    const Json json = parse_config_json(file, read_config_file(file));
    read_front(file, json, options, config.front);
    const Json defaults = json.value("defaults", Json::object());
    if (!json.contains("projects") || !json["projects"].is_object() || !defaults.is_object()) {
        throw UsageError(file + ": projects: must be an object with a project by its name");
    }
    if (json["projects"].size() > most_projects) {
        throw UsageError(file + ": projects: at most " + std::to_string(most_projects));
    }
    for (const auto& [name, own] : json["projects"].items()) {
        config.projects.push_back(read_project(file + ": projects." + name, name, own, defaults));
    }
    return config;
}

ProjectsConfig read_folder(const Options& options, ProjectsConfig config) {
    std::error_code problem;
    for (const auto& entry : fs::directory_iterator(options.projects.source, problem)) {
        const fs::path path = entry.path();
        if (path.extension() == ".glb" || path.extension() == ".gltf") {
            config.projects.push_back(read_project(path.string(), path.stem().string(),
                                                   Json{{"scene", path.string()}}, Json::object()));
        }
    }
    if (problem) {
        throw UsageError(options.projects.source + ": " + problem.message());
    }
    const auto name = [](const ProjectEntry& project) -> const std::string& {
        return project.name;
    };
    std::ranges::sort(config.projects, {}, name);
    const auto twice = std::ranges::adjacent_find(config.projects, {}, name);
    if (twice != config.projects.end()) {
        throw UsageError(options.projects.source + ": there are two scenes " + twice->name);
    }
    return config;
}

}  // namespace

ProjectsConfig read_projects(const Options& options) {
    ProjectsConfig config;
    config.front.network = options.network;
    config.front.log = options.log;
    config.front.projects = options.projects;
    config.front.network.max_connections = front_connections;
    config.front.network.max_connections_per_address = front_connections_per_address;
    std::error_code unknown;
    return fs::is_directory(options.projects.source, unknown)
               ? read_folder(options, std::move(config))
               : read_file(options, std::move(config));
}

std::string server_config(const ProjectEntry& project, const Options& front,
                          const std::string& state, const AccessToken* watch) {
    Json json = Json::parse(project.config);
    json["listen"] = "127.0.0.1:0";
    json["allowRemote"] = front.network.allow_remote;
    json["trustedProxies"] = front.network.trusted_proxies;
    json["trustedProxies"].push_back("127.0.0.1");
    if (!json.contains("journal") && project.serve.serve.redis.empty()) {
        json["journal"] = state + "/journal.db";
    }
    if (!project.serve.serve.redis.empty() && project.serve.serve.project.empty()) {
        json["project"] = project.name;
    }
    if (!json.contains("logFormat")) {
        json["logFormat"] = front.log.format;
    }
    if (!json.contains("logLevel")) {
        json["logLevel"] = front.log.level;
    }
    if (watch != nullptr) {
        json["tokens"].push_back({{"name", watch->name},
                                  {"role", v1::Role_Name(watch->role)},
                                  {"sha256", to_hex(watch->digest)}});
    }
    return json.dump(1) + "\n";
}

}  // namespace raybundle
