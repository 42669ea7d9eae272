// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace raybundle {

/// The only file in a folder, or below it, whose path differs from a relative one in nothing but
/// backslashes for slashes, letter case and the normal form of its Unicode. Nothing where there is
/// none or more than one, or where it lies outside of the folder, through a symbolic link either.
std::optional<std::filesystem::path> similar_file(const std::filesystem::path& folder,
                                                  const std::string& relative);

}  // namespace raybundle
