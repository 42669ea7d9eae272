// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace raybundle {

/// Writes bytes to a temporary name beside the path, then renames: the file appears whole or not at
/// all. Throws std::runtime_error.
void write_file(const std::string& path, const std::string& bytes);

/// Before work that takes long: throws std::runtime_error where no file could be written there,
/// since its folder is none or may not be written to.
void require_writable(const std::string& path);

}  // namespace raybundle
