// SPDX-License-Identifier: Apache-2.0
#include "scene/other_file.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace raybundle {
namespace {

struct Kind {
    std::string_view start;
    std::string_view name;
};

constexpr std::array kinds{
    Kind{"version https://git-lfs",
         "this is a Git LFS pointer: the file itself has not been fetched"},
    Kind{{"\xFF\xFE\xFF\x0ES\0k\0e\0t\0c\0h\0", 16}, "this is SketchUp"},
    Kind{"\xFF\xFE", "this is UTF-16 text"},
    Kind{"\xFE\xFF", "this is UTF-16 text"},
    Kind{"\x1F\x8B", "this is compressed (gzip)"},
    Kind{"PK\x03\x04", "this is a ZIP archive"},
    Kind{"<", "this is XML or HTML"},
    Kind{"ISO-10303-21", "this is IFC or STEP"},
    Kind{"3D Geometry File Format", "this is Rhinoceros 3DM"},
    Kind{"AC10", "this is DWG"},
    Kind{"solid ", "this is STL"},
    Kind{"ply\n", "this is PLY"},
    Kind{"ply\r", "this is PLY"},
    Kind{"%PDF", "this is PDF"},
    Kind{"glTF", "this is binary glTF"},
    Kind{"\x89PNG", "this is PNG"},
    Kind{"\xFF\xD8\xFF", "this is JPEG"},
    Kind{"GIF8", "this is GIF"},
    Kind{"BM", "this is BMP"},
    Kind{"DDS ", "this is DDS"},
    Kind{{"II*\0", 4}, "this is TIFF"},
    Kind{{"MM\0*", 4}, "this is TIFF"},
    Kind{"\x76\x2F\x31\x01", "this is OpenEXR"},
    Kind{"#?R", "this is Radiance HDR"},
    Kind{"Kaydara FBX", "this is FBX"},
    Kind{"BLENDER", "this is a Blender file"},
    Kind{"PXR-USDC", "this is USD"},
    Kind{"#usda", "this is USD"},
};

/// Wavefront OBJ has no mark of its own: its lines begin with what they are.
bool is_obj(std::string_view text) {
    constexpr std::string_view starts[] = {"v ", "mtllib ", "o ", "g "};
    constexpr int most_lines = 20;
    for (int line = 0; line < most_lines && !text.empty(); ++line) {
        if (std::any_of(std::begin(starts), std::end(starts),
                        [&](std::string_view start) { return text.starts_with(start); })) {
            return true;
        }
        if (text.front() != '#' && text.front() != '\n' && text.front() != '\r') {
            return false;
        }
        text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    }
    return false;
}

}  // namespace

std::string other_file_kind(std::span<const std::uint8_t> bytes) {
    if (bytes.empty()) {
        return "the file is empty";
    }
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const auto* const kind = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& candidate) {
        return text.starts_with(candidate.start);
    });
    if (kind == kinds.end()) {
        return is_obj(text) ? "this is Wavefront OBJ" : "";
    }
    return std::string(kind->name);
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
