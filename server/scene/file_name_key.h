// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace raybundle {

/// A text that is the same for names that differ only in letter case or in the normal form of their
/// Unicode: decomposed, as macOS writes names, and in lower case. Covers the Latin, Greek and
/// Cyrillic scripts, kana and Hangul; all else, and what is no UTF-8, stays as it is.
std::string file_name_key(std::string_view utf8);

}  // namespace raybundle
