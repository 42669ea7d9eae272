// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace raybundle {

/// Contents of files by their names, with / between folders.
using ZipEntries = std::map<std::string, std::string>;

/// A ZIP archive (PKWARE APPNOTE 6.3), deflated. The same entries give the same bytes.
std::string write_zip(const ZipEntries& entries);

struct ZipLimits {
    std::size_t most_entries = 4096;
    std::size_t most_bytes = 64U << 20U;  ///< of all contents, inflated
};
/// Reads an archive without encryption and ZIP64; nothing and a reason where it is none, is damaged
/// or beyond the limits. Names that lead out of it (.., absolute ones) are refused.
std::optional<ZipEntries> read_zip(std::string_view bytes, const ZipLimits& limits,
                                   std::string& reason);

}  // namespace raybundle
