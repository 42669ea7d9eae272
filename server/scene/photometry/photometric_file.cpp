// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <fstream>

#include "scene/gltf/gltf_loader.h"
#include "scene/photometry/ies_profile.h"
#include "scene/photometry/ies_text.h"

namespace raybundle {
namespace {

constexpr std::streamsize max_read =
    (16 << 20) + 1;  // one more than plain_photometric_text() takes

/// Whether a text without TILT= is EULUMDAT: a line of text, then one number a line: type,
/// symmetry, planes, their distance, angles in a plane.
bool is_eulumdat(const std::string& file, const std::string& text) {
    constexpr int max_lines = 10'000;
    IesReader lines(file, text);
    for (int i = 0; i < max_lines && !lines.at_end(); ++i) {
        if (compact(lines.next_line()).starts_with("TILT=")) {
            return false;
        }
    }
    IesReader reader(file, text);
    while (!reader.at_end() && compact(reader.next_line()).empty()) {
    }
    for (int numbers = 0; numbers < 5;) {
        if (reader.at_end()) {
            return false;
        }
        const std::string line = compact(reader.next_line());
        if (line.find_first_not_of("0123456789.,+-E") != std::string::npos) {
            return false;
        }
        numbers += line.empty() ? 0 : 1;
    }
    return true;
}

}  // namespace

IesProfile parse_photometry(const std::string& file, std::string_view bytes) {
    return is_eulumdat(file, plain_photometric_text(file, bytes)) ? parse_eulumdat(file, bytes)
                                                                  : parse_ies(file, bytes);
}

IesProfile read_photometry(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    if (!in) {
        throw SceneError(path, "", "cannot be opened");
    }
    std::string text(max_read, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    return parse_photometry(path, text);
}

}  // namespace raybundle
