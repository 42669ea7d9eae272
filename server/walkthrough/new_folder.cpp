// SPDX-License-Identifier: Apache-2.0
#include "walkthrough/new_folder.h"

#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace raybundle {

namespace {

namespace fs = std::filesystem;

/// What every folder that may be replaced holds.
constexpr const char* mark = "scene.json";

[[noreturn]] void refuse(const fs::path& path, const std::string& reason) {
    throw std::runtime_error(path.string() + ": cannot be written: " + reason);
}

/// Without a slash at its end, which would leave it without a name.
fs::path named(const std::string& path) {
    const fs::path normal = fs::path(path).lexically_normal();
    return normal.has_filename() ? normal : normal.parent_path();
}

fs::path folder_of(const fs::path& path) {
    return path.parent_path().empty() ? fs::path(".") : path.parent_path();
}

fs::path beside(const fs::path& path, const std::string& ending) {
    return folder_of(path) / ("." + path.filename().string() + ending);
}

}  // namespace

void check_new_folder(const std::string& path, bool replace) {
    const fs::path target = named(path);
    const std::string name = target.filename().string();
    if (name.empty() || name == "." || name == "..") {
        refuse(path, "it is no name of a new folder");
    }
    const fs::path parent = folder_of(target);
    std::error_code error;
    if (!fs::is_directory(parent, error)) {
        refuse(path, "there is no folder '" + parent.string() + "'");
    }
    if (access(parent.c_str(), W_OK | X_OK) != 0) {
        refuse(path, "the folder '" + parent.string() + "' may not be written to");
    }
    const fs::file_status status = fs::symlink_status(target, error);
    if (!fs::exists(status)) {
        return;
    }
    if (!fs::is_directory(status)) {
        refuse(path, "it is no folder");
    }
    const bool empty = fs::is_empty(target, error);
    if (error) {
        refuse(path, error.message());
    }
    if (!empty && !replace) {
        refuse(path, "the folder is not empty (--force replaces an earlier walkthrough)");
    }
    if (!empty && !fs::exists(target / mark)) {
        refuse(path, "the folder holds something else than a walkthrough: it has no " +
                         std::string(mark));
    }
}

NewFolder::NewFolder(const std::string& path, bool replace) : path_(named(path)) {
    check_new_folder(path, replace);
    std::string pattern = beside(path_, ".part.XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
        refuse(path, "no folder can be made beside it");
    }
    temporary_ = pattern;
    replaced_ = pattern + ".old";
}

NewFolder::~NewFolder() {
    if (!temporary_.empty()) {
        std::error_code ignored;
        fs::remove_all(temporary_, ignored);
    }
}

fs::path NewFolder::file(const std::string& name) const {
    fs::path result = temporary_ / name;
    std::error_code error;
    fs::create_directories(result.parent_path(), error);
    if (error) {
        refuse(result, error.message());
    }
    return result;
}

void NewFolder::keep() {
    // mkdtemp() lets nobody else in; a web server has another user.
    std::error_code error;
    fs::permissions(temporary_, fs::perms(0755), error);
    const bool there = !error && fs::exists(path_);
    if (there) {
        fs::rename(path_, replaced_, error);
    }
    if (!error) {
        fs::rename(temporary_, path_, error);
        if (error && there) {
            std::error_code ignored;
            fs::rename(replaced_, path_, ignored);
        }
    }
    if (error) {
        refuse(path_, error.message());
    }
    temporary_.clear();
    fs::remove_all(replaced_, error);
}

void write_bytes(const fs::path& file, std::string_view bytes) {
    std::ofstream stream(file, std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream) {
        refuse(file, "the disk may be full");
    }
}

}  // namespace raybundle
