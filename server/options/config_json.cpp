// SPDX-License-Identifier: Apache-2.0
#include "options/config_json.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "options/cli_options.h"

namespace raybundle {
namespace {

constexpr std::size_t max_file_bytes = 1U << 20U;

}  // namespace

std::string read_config_file(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string text(max_file_bytes + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (!stream.is_open() || stream.bad()) {
        throw UsageError(file + ": cannot be read");
    }
    if (text.size() > max_file_bytes) {
        throw UsageError(file + ": is larger than 1 MiB");
    }
    return text;
}

ConfigJson parse_config_json(const std::string& name, const std::string& text) {
    std::vector<std::set<std::string>> seen;
    const auto callback = [&](int depth, ConfigJson::parse_event_t event, ConfigJson& parsed) {
        const auto level = static_cast<std::size_t>(depth);
        if (event == ConfigJson::parse_event_t::object_start) {
            seen.resize(level + 1);
            seen[level].clear();
        } else if (event == ConfigJson::parse_event_t::key &&
                   !seen[level - 1].insert(parsed.get<std::string>()).second) {
            throw UsageError(name + ": " + parsed.get<std::string>() + ": is there twice");
        }
        return true;
    };
    try {
        ConfigJson json = ConfigJson::parse(text, callback);
        if (!json.is_object()) {
            throw UsageError(name + ": must hold one JSON object");
        }
        return json;
    } catch (const nlohmann::json::exception& error) {
        const std::string reason = error.what();
        throw UsageError(name + ": " + reason.substr(reason.find("] ") + 2));
    }
}

}  // namespace raybundle
