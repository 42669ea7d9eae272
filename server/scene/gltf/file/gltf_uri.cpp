// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/file/gltf_uri.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "scene/gltf/file/gltf_container.h"
#include "scene/gltf/file/gltf_similar_file.h"
#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

constexpr std::uint8_t not_base64 = 0xff;

constexpr std::array<std::uint8_t, 256> base64_values() {
    std::array<std::uint8_t, 256> values{};
    values.fill(not_base64);
    constexpr std::string_view alphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < alphabet.size(); ++i) {
        values[static_cast<std::uint8_t>(alphabet[i])] = static_cast<std::uint8_t>(i);
    }
    // RFC 4648 section 5, the URL-safe alphabet.
    values['-'] = 62;
    values['_'] = 63;
    return values;
}

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

/// False if the text is not base64. Lines may be wrapped, as in mail.
bool decode_base64(std::string_view text, std::vector<std::uint8_t>& bytes) {
    static constexpr std::array<std::uint8_t, 256> values = base64_values();
    while (!text.empty() && (text.back() == '=' || is_blank(text.back()))) {
        text.remove_suffix(1);
    }
    std::size_t digits = 0;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        if (is_blank(c)) {
            continue;
        }
        ++digits;
        const std::uint8_t value = values[static_cast<std::uint8_t>(c)];
        if (value == not_base64) {
            return false;
        }
        bits = (bits << 6U) | value;
        count += 6;
        if (count >= 8) {
            count -= 8;
            bytes.push_back(static_cast<std::uint8_t>(bits >> static_cast<unsigned>(count)));
        }
    }
    return digits % 4 != 1;
}

/// Whether "data:image/png;base64" names the encoding, in any case, which a browser reads too.
bool names_base64(std::string_view header) {
    while (!header.empty()) {
        const std::size_t end = std::min(header.find(';'), header.size());
        std::string name;
        for (const char c : header.substr(0, end)) {
            if (!is_blank(c)) {
                name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
            }
        }
        if (name == "base64") {
            return true;
        }
        header.remove_prefix(std::min(end + 1, header.size()));
    }
    return false;
}

std::vector<std::uint8_t> decode_data_uri(const std::string& scene_file,
                                          const std::string& json_path, std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) {
        throw SceneError(scene_file, json_path, "data URI without a comma");
    }
    const std::string_view header = uri.substr(0, comma);
    const std::string_view body = uri.substr(comma + 1);
    if (!names_base64(header)) {
        const std::string plain = percent_decoded(body);
        return {plain.begin(), plain.end()};
    }
    std::vector<std::uint8_t> bytes;
    // Some exporters escape "+", "/" and "=" inside the base64 text.
    const bool escaped = body.find('%') != std::string_view::npos;
    if (!decode_base64(escaped ? percent_decoded(body) : body, bytes)) {
        throw SceneError(scene_file, json_path, "data URI is not valid base64");
    }
    return bytes;
}

bool has_scheme(std::string_view uri) {
    const std::size_t colon = uri.find(':');
    return colon != std::string_view::npos && colon > 0 && uri.find('/') > colon;
}

int hex_digit(char c) {
    const int lower = std::tolower(static_cast<unsigned char>(c));
    if (lower >= '0' && lower <= '9') {
        return lower - '0';
    }
    return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

}  // namespace

std::string percent_decoded(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 &&
            hex_digit(text[i + 2]) >= 0) {
            decoded.push_back(
                static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2])));
            i += 2;
        } else {
            decoded.push_back(text[i]);
        }
    }
    return decoded;
}

std::string local_file(const std::string& scene_file, const std::string& json_path,
                       const std::string& uri) {
    if (uri.empty()) {
        throw SceneError(scene_file, json_path, "empty URI");
    }
    const std::filesystem::path relative(percent_decoded(uri));
    if (has_scheme(uri) || relative.is_absolute()) {
        throw SceneError(
            scene_file, json_path,
            fmt::format("\"{}\": only data URIs and relative paths are read", uri.substr(0, 200)));
    }
    if (relative.native().find('\0') != std::string::npos) {
        throw SceneError(scene_file, json_path, "URI contains a zero byte");
    }
    const std::filesystem::path folder = std::filesystem::path(scene_file).parent_path();
    // Files whose names contain a literal "%" are looked for as written, too.
    std::error_code error;
    if (std::filesystem::exists(folder / relative, error)) {
        return (folder / relative).string();
    }
    if (std::filesystem::exists(folder / uri, error)) {
        return (folder / uri).string();
    }
    return similar_file(folder, relative.native()).value_or(folder / relative).string();
}

std::optional<std::string> other_spelling(const std::string& scene_file,
                                          const std::string& json_path, const std::string& uri) {
    if (uri.starts_with("data:")) {
        return std::nullopt;
    }
    const std::filesystem::path folder = std::filesystem::path(scene_file).parent_path();
    const std::filesystem::path found(local_file(scene_file, json_path, uri));
    if (found == folder / percent_decoded(uri) || found == folder / uri) {
        return std::nullopt;
    }
    return folder.empty() ? found.string() : found.lexically_relative(folder).string();
}

std::vector<std::uint8_t> read_uri(const std::string& scene_file, const std::string& json_path,
                                   const std::string& uri, std::uint64_t max_bytes) {
    if (uri.starts_with("data:")) {
        return decode_data_uri(scene_file, json_path, uri);
    }
    return read_file_bounded(local_file(scene_file, json_path, uri), max_bytes, scene_file,
                             json_path);
}

void check_uri(const std::string& scene_file, const std::string& json_path,
               const std::string& uri) {
    if (uri.starts_with("data:")) {
        return;
    }
    require_file(local_file(scene_file, json_path, uri), scene_file, json_path);
}

}  // namespace raybundle
