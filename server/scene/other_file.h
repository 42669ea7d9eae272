// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace raybundle {

/// What a file is instead of what it should be, by its first bytes, e.g. "this is a Git LFS
/// pointer: the file itself has not been fetched"; empty: not known.
std::string other_file_kind(std::span<const std::uint8_t> bytes);

/// A message of a library as one line of ASCII; bytes of the file in it that are neither become
/// '?', since logs and answers to clients are UTF-8.
std::string plain_message(std::string_view message);

}  // namespace raybundle
