// SPDX-License-Identifier: Apache-2.0
#include "app/scene_library.h"

#include <fcntl.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <map>
#include <system_error>
#include <utility>

#include "net/http/scene_name.h"
#include "options/cli_options.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view upload_prefix = ".upload-";
constexpr std::string_view upload_suffix = ".glb";

bool is_scene(const fs::directory_entry& entry) {
    std::error_code ignored;
    return entry.symlink_status(ignored).type() == fs::file_type::regular &&
           scene_name_problem(entry.path().filename().string()).empty();
}

double unix_ms(fs::file_time_type time) {
    const auto since = std::chrono::file_clock::to_sys(time).time_since_epoch();
    return std::chrono::duration<double, std::milli>(since).count();
}

[[noreturn]] void fail(const fs::path& path) {
    throw fs::filesystem_error("write", path, std::error_code(errno, std::generic_category()));
}

}  // namespace

void NewSceneFile::discard() {
    if (descriptor_ >= 0) {
        close(std::exchange(descriptor_, -1));
    }
    if (!path_.empty()) {
        unlink(path_.c_str());
        path_.clear();
    }
}

bool NewSceneFile::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const auto count = ::write(descriptor_, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count <= 0) {
            return false;
        }
        bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return true;
}

bool NewSceneFile::keep_as(const std::string& name) {
    const fs::path target = path_.parent_path() / name;
    if (fchmod(descriptor_, 0640) != 0 || fsync(descriptor_) != 0) {
        fail(target);
    }
    const bool replaced = fs::exists(fs::symlink_status(target));
    fs::rename(path_, target);
    path_.clear();
    const int folder = open(target.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0) {
        fsync(folder);  // its name survives a power cut, too; where that fails the file is there
        close(folder);
    }
    return replaced;
}

SceneLibrary::SceneLibrary(const std::string& folder) {
    std::error_code error;
    folder_ = fs::canonical(folder, error);
    if (error || !fs::is_directory(folder_)) {
        throw UsageError("--scenes: '" + folder + "' is not a folder");
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
        if (entry.path().filename().string().starts_with(upload_prefix)) {
            fs::remove(entry.path(), error);
        }
    }
}

void SceneLibrary::list(const std::string& shown, v1::SceneList* list) const {
    std::map<std::string, v1::SceneFile> scenes;
    std::error_code error;
    const fs::path current = fs::canonical(shown, error);
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_, error)) {
        if (!is_scene(entry)) {
            continue;
        }
        const std::string name = entry.path().filename().string();
        v1::SceneFile& scene = scenes[name];
        scene.set_name(name);
        scene.set_bytes(static_cast<double>(entry.file_size(error)));
        scene.set_changed_at_ms(unix_ms(entry.last_write_time(error)));
        if (entry.path() == current) {
            list->set_current(name);
        }
    }
    for (const auto& [name, scene] : scenes) {
        if (list->scenes_size() < max_scenes) {
            *list->add_scenes() = scene;
        }
    }
}

std::optional<std::string> SceneLibrary::find(const std::string& name) const {
    const fs::path path = folder_ / name;
    std::error_code error;
    const fs::directory_entry entry(path, error);
    return scene_name_problem(name).empty() && !error && is_scene(entry)
               ? std::optional(path.string())
               : std::nullopt;
}

std::unique_ptr<NewSceneFile> new_file(const fs::path& folder, std::string_view suffix) {
    std::string path = folder / (std::string(upload_prefix) + "XXXXXX");
    path += suffix;
    const int descriptor = mkostemps(path.data(), static_cast<int>(suffix.size()), O_CLOEXEC);
    if (descriptor < 0) {
        spdlog::error("an upload cannot be stored in {}: {}", folder.string(),
                      std::generic_category().message(errno));
        return nullptr;
    }
    return std::make_unique<NewSceneFile>(path, descriptor);
}

std::unique_ptr<NewSceneFile> SceneLibrary::create() const {
    return new_file(folder_, upload_suffix);
}

std::string SceneLibrary::without_paths(std::string text) const {
    const std::string prefix = folder_.string() + "/";
    for (std::size_t at = 0; (at = text.find(prefix, at)) != std::string::npos;) {
        text.erase(at, prefix.size());
    }
    return text;
}

}  // namespace raybundle
