// SPDX-License-Identifier: Apache-2.0
#include "projects/project_list.h"

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <sstream>

#include "net/http/metrics_text.h"

namespace raybundle {
namespace {

using Json = nlohmann::ordered_json;

std::string label_of(std::string_view name) {
    return "project=\"" + std::string(name) + "\"";
}

void add_details(Json& entry, const Project& project, const ProcessUsage& usage) {
    const ProjectSettings& settings = project.settings();
    std::error_code unknown;
    const auto bytes = std::filesystem::file_size(settings.scene, unknown);
    entry["sceneBytes"] = unknown ? 0 : bytes;
    entry["memoryBytes"] = usage.memory_bytes;
    entry["maxViewers"] = settings.max_viewers;
    entry["people"] = project.watch().people();
    if (!project.picture().empty()) {
        const std::size_t version = std::hash<std::string>()(project.picture());
        entry["picture"] =
            "pictures/" + settings.name + ".png?" + std::to_string(version % 1'000'000'007U);
    }
}

Json describe(const Project& project, const ProcessUsage& usage, FrontTime now, bool trusted) {
    const ProjectSettings& settings = project.settings();
    const bool open = trusted || !settings.secret();
    Json entry{{"name", settings.name},
               {"title", open ? settings.title : settings.name},
               {"path", "p/" + settings.name + "/"},
               {"state", name_of(project.state())},
               {"needsToken", settings.secret()}};
    if (open) {
        add_details(entry, project, usage);
    }
    if (const std::string problem = project.problem(now); !problem.empty()) {
        entry["problem"] = problem;
    }
    return entry;
}

struct Family {
    std::string name, head, samples;
};

/// "name{a="b"} 1" or "name 1" with another label in front.
std::string labelled(const std::string& sample, const std::string& label) {
    const std::size_t end = sample.find_first_of("{ ");
    if (end == std::string::npos) {
        return "";
    }
    return sample[end] == '{'
               ? sample.substr(0, end + 1) + label + "," + sample.substr(end + 1) + "\n"
               : sample.substr(0, end) + "{" + label + "}" + sample.substr(end) + "\n";
}

Family& family_named(std::vector<Family>& families, const std::string& name) {
    for (Family& family : families) {
        if (family.name == name) {
            return family;
        }
    }
    return families.emplace_back(Family{name, "", ""});
}

}  // namespace

std::string projects_json(const Projects& projects, FrontTime now, bool trusted) {
    Json list = Json::array();
    for (const auto& [name, project] : projects.all()) {
        list.push_back(describe(*project, projects.usage_of(name), now, trusted));
    }
    return Json{{"projects", std::move(list)}}.dump(-1, ' ', false,
                                                    Json::error_handler_t::replace) +
           "\n";
}

std::string merged_metrics(const std::vector<std::pair<std::string, std::string>>& figures) {
    std::vector<Family> families;
    for (const auto& [project, text] : figures) {
        Family* family = nullptr;
        bool first = false;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            constexpr std::string_view help = "# HELP ";
            if (line.starts_with(help)) {
                const std::size_t end = line.find(' ', help.size());
                family = &family_named(families, line.substr(help.size(), end - help.size()));
                first = family->head.empty();
            }
            if (family == nullptr || line.empty()) {
                continue;
            }
            if (line.starts_with('#')) {
                family->head += first ? line + "\n" : "";
            } else {
                family->samples += labelled(line, label_of(project));
            }
        }
    }
    std::string text;
    for (const Family& family : families) {
        text += family.head + family.samples;
    }
    return text;
}

std::string projects_metrics(const Projects& projects, std::size_t connections) {
    MetricsText out;
    out.gauge("raybundle_projects", "Projects that are served",
              static_cast<double>(projects.all().size()));
    out.gauge("raybundle_projects_connections", "Connections of the front, visits among them",
              static_cast<double>(connections));
    const auto family = [&](const char* name, const char* type, const char* help,
                            const auto& value) {
        out.family(name, type, help);
        for (const auto& [project, entry] : projects.all()) {
            out.sample(name, label_of(project), value(*entry));
        }
    };
    const auto usage = [&](const Project& project) {
        return projects.usage_of(project.settings().name);
    };
    family(
        "raybundle_project_awake", "gauge", "1 while its server gets processor time",
        [](const Project& project) { return project.state() == ProjectState::awake ? 1.0 : 0.0; });
    family(
        "raybundle_project_asleep", "gauge", "1 while its server is stopped",
        [](const Project& project) { return project.state() == ProjectState::asleep ? 1.0 : 0.0; });
    family(
        "raybundle_project_failed", "gauge", "1 after its server has ended by itself",
        [](const Project& project) { return project.state() == ProjectState::failed ? 1.0 : 0.0; });
    family("raybundle_project_visits", "gauge", "Connections that lead to its server",
           [](const Project& project) { return static_cast<double>(project.visits()); });
    family("raybundle_project_starts_total", "counter", "Times that its server was started",
           [](const Project& project) { return static_cast<double>(project.starts()); });
    family(
        "raybundle_project_memory_bytes", "gauge", "Memory of its server's own, swap included",
        [&](const Project& project) { return static_cast<double>(usage(project).memory_bytes); });
    family("raybundle_project_processor_seconds", "gauge",
           "Processor time of its server since that has started",
           [&](const Project& project) { return usage(project).processor_s; });
    std::vector<std::pair<std::string, std::string>> figures;
    for (const auto& [name, project] : projects.all()) {
        figures.emplace_back(name, project->watch().figures());
    }
    return out.text() + merged_metrics(figures);
}

}  // namespace raybundle
