// SPDX-License-Identifier: Apache-2.0
#include "view/whole_file.h"

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

}  // namespace raybundle
