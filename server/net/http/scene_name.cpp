// SPDX-License-Identifier: Apache-2.0
#include "net/http/scene_name.h"

#include <algorithm>
#include <cctype>

namespace raybundle {
namespace {

constexpr std::size_t kMaxBytes = 128;
constexpr std::string_view kFolder = "/scenes/";
constexpr std::string_view kPhotometryFolder = "/photometry/";

bool forbidden(char character) {
    constexpr std::string_view kForbidden = "/\\\"<>|:*?%\x7f";
    return static_cast<unsigned char>(character) < 0x20 ||
           kForbidden.find(character) != std::string_view::npos;
}

/// Bytes of the well-formed UTF-8 sequence that `text` begins with (Unicode 15, table 3-7), 0 where
/// it begins with none.
std::size_t sequence_length(std::string_view text) {
    const auto byte = [text](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
    const unsigned first = byte(0);
    const unsigned second = byte(1);
    if (first < 0x80U) {
        return 1;
    }
    if (first >= 0xC2U && first <= 0xDFU) {
        return continues(1) ? 2 : 0;
    }
    if (first >= 0xE0U && first <= 0xEFU) {
        const bool fits = (first != 0xE0U || second >= 0xA0U) && (first != 0xEDU || second < 0xA0U);
        return fits && continues(1) && continues(2) ? 3 : 0;
    }
    const bool fits = first >= 0xF0U && first <= 0xF4U && (first != 0xF0U || second >= 0x90U) &&
                      (first != 0xF4U || second < 0x90U);
    return fits && continues(1) && continues(2) && continues(3) ? 4 : 0;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t length = sequence_length(text);
        if (length == 0) {
            return false;
        }
        text.remove_prefix(length);
    }
    return true;
}

std::string file_name_problem(std::string_view name) {
    if (name.empty() || name.size() > kMaxBytes) {
        return "must be 1..128 bytes";
    }
    if (name.front() == '.' || std::any_of(name.begin(), name.end(), forbidden) || !is_utf8(name)) {
        return "must be a plain file name, without folders";
    }
    return "";
}

}  // namespace

std::string scene_name_problem(std::string_view name) {
    if (const std::string problem = file_name_problem(name); !problem.empty()) {
        return problem;
    }
    return name.ends_with(".glb") || name.ends_with(".gltf") ? "" : "must end with .glb or .gltf";
}

std::string photometry_name_problem(std::string_view name) {
    if (const std::string problem = file_name_problem(name); !problem.empty()) {
        return problem;
    }
    std::string ending(name.substr(name.size() - std::min<std::size_t>(name.size(), 4)));
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending == ".ies" || ending == ".ldt" ? "" : "must end with .ies or .ldt";
}

std::string_view photometry_of_path(std::string_view path) {
    return path.starts_with(kPhotometryFolder) ? path.substr(kPhotometryFolder.size())
                                               : std::string_view();
}

std::string_view scene_of_path(std::string_view path) {
    return path.starts_with(kFolder) ? path.substr(kFolder.size()) : std::string_view();
}

}  // namespace raybundle
