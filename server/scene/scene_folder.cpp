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

/// What has been read of a file, and still holds.
std::optional<SceneFolder::Known> SceneFolder::known(const std::string& name) const {
    Known found;
    {
        const std::lock_guard lock(mutex_);
        const auto entry = files_.find(name);
        if (entry == files_.end()) {
            return std::nullopt;
        }
        found = entry->second;
    }
    std::error_code error;
    const fs::path path = photometry_folder() / name;
    const bool stays = found.profile || (fs::file_size(path, error) == found.bytes &&
                                         fs::last_write_time(path, error) == found.changed);
    return stays ? std::optional(std::move(found)) : std::nullopt;
}

std::uint64_t SceneFolder::unread_bytes(const std::string& name) const {
    const fs::path path = photometry_folder() / name;
    std::error_code error;
    const bool to_read = is_photometry_name(name) && is_file(path) && !known(name);
    const std::uint64_t bytes = to_read ? fs::file_size(path, error) : 0;
    return error ? 0 : bytes;
}

std::shared_ptr<const IesProfile> SceneFolder::photometry(const std::string& name) const {
    std::optional<Known> file = known(name);
    if (!file) {
        const fs::path path = photometry_folder() / name;
        if (!is_photometry_name(name) || !is_file(path)) {
            throw SceneError(name, "", "there is no such photometric file");
        }
        std::error_code error;
        file.emplace();
        file->bytes = fs::file_size(path, error);
        file->changed = fs::last_write_time(path, error);
        try {
            file->profile = std::make_shared<const IesProfile>(read_photometry(path.string()));
        } catch (const SceneError& wrong) {
            file->json_path = wrong.json_path();
            file->reason = wrong.reason();
        }
        const std::lock_guard lock(mutex_);
        if (files_.size() >= max_photometric_files && !files_.contains(name)) {
            std::erase_if(files_, [](const auto& entry) { return !entry.second.profile; });
        }
        Known& kept = files_[name];
        if (kept.profile) {  // another thread was quicker: there is one profile of a file
            file = kept;
        } else {
            kept = *file;
        }
    }
    if (!file->profile) {
        throw SceneError(name, file->json_path, file->reason);
    }
    return file->profile;
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
