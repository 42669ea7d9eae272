// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_folder.h"

#include <algorithm>
#include <cctype>
#include <system_error>
#include <utility>

#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;

bool ends_with(std::string_view name, std::string_view suffix) {
    return name.size() > suffix.size() &&
           std::equal(suffix.rbegin(), suffix.rend(), name.rbegin(), [](char a, char b) {
               return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
           });
}

/// A file of the folder itself: no path, nothing hidden.
bool is_plain(std::string_view name) {
    return !name.empty() && name.front() != '.' &&
           name.find_first_of(std::string_view("/\\\0", 3)) == std::string_view::npos;
}

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::symlink_status(path, error).type() == fs::file_type::regular;
}

}  // namespace

bool is_photometry_name(std::string_view name) {
    return is_plain(name) && (ends_with(name, ".ies") || ends_with(name, ".ldt"));
}

SceneFolder::SceneFolder(fs::path folder) : folder_(std::move(folder)) {}

fs::path SceneFolder::photometry_folder() const {
    return folder_ / "photometry";
}

std::vector<std::string> SceneFolder::photometry_names() const {
    std::vector<std::string> names;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(photometry_folder(), error)) {
        const std::string name = entry.path().filename().string();
        if (is_photometry_name(name) && is_file(entry.path())) {
            names.push_back(name);
        }
    }
    std::sort(names.begin(), names.end());
    names.resize(std::min(names.size(), max_photometric_files));
    return names;
}

std::shared_ptr<const IesProfile> SceneFolder::photometry(const std::string& name) const {
    const std::lock_guard lock(mutex_);
    if (const auto known = profiles_.find(name); known != profiles_.end()) {
        return known->second;
    }
    const fs::path path = photometry_folder() / name;
    if (!is_photometry_name(name) || !is_file(path)) {
        throw SceneError(name, "", "there is no such photometric file");
    }
    try {
        const auto profile = std::make_shared<const IesProfile>(read_photometry(path.string()));
        profiles_[name] = profile;
        return profile;
    } catch (const SceneError& error) {
        throw SceneError(name, error.json_path(), error.reason());
    }
}

std::string SceneFolder::scene_file(const std::string& name) const {
    const fs::path path = folder_ / name;
    if (!is_plain(name) || !(ends_with(name, ".glb") || ends_with(name, ".gltf")) ||
        !is_file(path)) {
        throw SceneError(name, "", "there is no such scene file");
    }
    return path.string();
}

}  // namespace raybundle
