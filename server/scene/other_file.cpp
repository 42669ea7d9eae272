// SPDX-License-Identifier: Apache-2.0
#include "scene/other_file.h"

#include <algorithm>
#include <array>

namespace raybundle {
namespace {

struct Kind {
    std::string_view start;
    std::string_view name;
};

constexpr std::array kinds{
    Kind{"version https://git-lfs",
         "this is a Git LFS pointer: the file itself has not been fetched"},
    Kind{"\xFF\xFE", "this is UTF-16 text"},
    Kind{"\xFE\xFF", "this is UTF-16 text"},
    Kind{"\x1F\x8B", "this is compressed (gzip)"},
    Kind{"PK\x03\x04", "this is a ZIP archive"},
    Kind{"<", "this is XML or HTML"},
    Kind{"Kaydara FBX", "this is FBX"},
    Kind{"BLENDER", "this is a Blender file"},
    Kind{"PXR-USDC", "this is USD"},
    Kind{"#usda", "this is USD"},
};

}  // namespace

std::string other_file_kind(std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) {
        return "the file is empty";
    }
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto* const kind = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& candidate) {
        return text.starts_with(candidate.start);
    });
    return kind == kinds.end() ? "" : std::string(kind->name);
}

std::string plain_message(std::string_view message) {
    std::string line;
    for (const char c : message) {
        if (c == '\n' || c == '\r') {
            line += line.empty() || line.ends_with("; ") ? "" : "; ";
        } else {
            line += c >= ' ' && c <= '~' ? c : '?';
        }
    }
    while (line.ends_with("; ")) {
        line.resize(line.size() - 2);
    }
    return line;
}

}  // namespace raybundle
