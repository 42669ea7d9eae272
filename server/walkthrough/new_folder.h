// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace raybundle {

/// Throws std::runtime_error, naming the folder and the reason, where NewFolder(path, replace)
/// would: before work that takes long.
void check_new_folder(const std::string& path, bool replace);

/// A folder that appears whole or not at all: it is filled under a hidden name beside its own, and
/// gone again unless keep() is called.
class NewFolder {
  public:
    /// Throws std::runtime_error where `path` is a file, has files in it (unless `replace`, and it
    /// is an earlier walkthrough), or its parent may not be written to.
    NewFolder(const std::string& path, bool replace);
    ~NewFolder();
    NewFolder(const NewFolder&) = delete;
    NewFolder& operator=(const NewFolder&) = delete;

    /// Place of a file for now; folders on the way are made. name: relative.
    [[nodiscard]] std::filesystem::path file(const std::string& name) const;
    /// Gives it its own name, in the place of what was there. Throws std::runtime_error.
    void keep();

  private:
    std::filesystem::path path_, temporary_, replaced_;
};

/// Writes bytes to a new file. Throws std::runtime_error naming it.
void write_bytes(const std::filesystem::path& file, std::string_view bytes);

}  // namespace raybundle
