// SPDX-License-Identifier: Apache-2.0
#include "view/image/whole_file.h"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace raybundle {

void write_file(const std::string& path, const std::string& bytes) {
    namespace fs = std::filesystem;
    const fs::path target(path);
    const fs::path temporary = target.parent_path() / ("." + target.filename().string() + ".part");
    std::ofstream stream(temporary, std::ios::binary);
    stream << bytes;
    stream.close();
    std::error_code error;
    if (stream) {
        fs::rename(temporary, target, error);
    }
    if (!stream || error) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        throw std::runtime_error(path + ": cannot be written");
    }
}

void require_writable(const std::string& path) {
    namespace fs = std::filesystem;
    const fs::path parent = fs::path(path).parent_path();
    const std::string folder = parent.empty() ? "." : parent.string();
    std::error_code error;
    if (!fs::is_directory(folder, error)) {
        throw std::runtime_error(path + ": cannot be written: there is no folder '" + folder + "'");
    }
    if (access(folder.c_str(), W_OK | X_OK) != 0) {
        throw std::runtime_error(path + ": cannot be written: the folder '" + folder +
                                 "' may not be written to");
    }
}

}  // namespace raybundle
