// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/page_files.h"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <stdexcept>

namespace raybundle {

namespace {

constexpr const char* page = "walkthrough.html";

const EmbeddedFile& find(std::span<const EmbeddedFile> files, const std::string& name) {
    const auto found = std::find_if(files.begin(), files.end(),
                                    [&](const EmbeddedFile& file) { return file.name == name; });
    if (found == files.end()) {
        throw std::logic_error(name + ": is not among the files of the page");
    }
    return *found;
}

/// Files that a page or a module needs: scripts and styles, or what is imported. What comments name
/// as types is none.
std::vector<std::string> needed_by(const EmbeddedFile& file) {
    static const std::regex import(
        R"((?:^|\n)(?:import|export)\s(?:[^'";]*\sfrom\s+)?'(\.[^']+)')");
    static const std::regex linked("(?:href|src)=\"([\\w/.]+\\.(?:css|js))\"");
    const std::string text(file.contents);
    const std::filesystem::path folder = std::filesystem::path(file.name).parent_path();
    const std::regex& needed = file.name == page ? linked : import;
    std::vector<std::string> names;
    for (std::sregex_iterator i(text.begin(), text.end(), needed), end; i != end; ++i) {
        names.push_back((folder / (*i)[1].str()).lexically_normal().generic_string());
    }
    return names;
}

/// The text of a shader, what it includes first.
std::string whole_text(std::span<const EmbeddedFile> shaders, const std::string& name) {
    const auto found = std::find_if(shaders.begin(), shaders.end(), [&](const EmbeddedFile& file) {
        return std::filesystem::path(file.name).filename() == name;
    });
    if (found == shaders.end()) {
        throw std::logic_error(name + ": is not among the shaders");
    }
    static const std::regex include(R"x(#include "([^"]+)"\n)x");
    const std::string text(found->contents);
    std::string before;
    for (std::sregex_iterator i(text.begin(), text.end(), include), end; i != end; ++i) {
        before += whole_text(shaders, (*i)[1].str());
    }
    return before + std::regex_replace(text, include, "");
}

}  // namespace

std::vector<EmbeddedFile> walkthrough_page(std::span<const EmbeddedFile> client) {
    std::vector<EmbeddedFile> files;
    std::vector<std::string> waiting = {page};
    std::set<std::string> known(waiting.begin(), waiting.end());
    while (!waiting.empty()) {
        const EmbeddedFile& file = find(client, waiting.back());
        waiting.pop_back();
        files.push_back(file);
        for (const std::string& name : needed_by(file)) {
            if (known.insert(name).second) {
                waiting.push_back(name);
            }
        }
    }
    files.front().name = "index.html";
    return files;
}

std::vector<ShaderText> walkthrough_shaders(std::span<const EmbeddedFile> shaders) {
    std::vector<ShaderText> texts;
    for (const char* name : {"tone_curve.glsl", "false_colour.glsl"}) {
        texts.push_back({std::string("shaders/") + name, whole_text(shaders, name)});
    }
    return texts;
}

}  // namespace raybundle
