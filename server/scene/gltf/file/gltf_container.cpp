// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/file/gltf_container.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string_view>
#include <unordered_set>

#include "scene/gltf/gltf_loader.h"
#include "scene/other_file.h"

namespace raybundle {
namespace {

constexpr std::uint64_t max_scene_file_bytes = 2ULL << 30U;
// Deeper than any exporter nests; bounds the recursion of everything that walks the JSON.
constexpr int max_json_depth = 128;
// Derived: a token (a value, a key, an end) takes up to 50 bytes in memory, so these are at most 1
// GB.
constexpr std::size_t max_json_tokens = 20'000'000;
constexpr std::uint32_t glb_magic = 0x46546C67;
constexpr std::uint32_t chunk_json = 0x4E4F534A;
constexpr std::uint32_t chunk_binary = 0x004E4942;
constexpr std::size_t glb_header_bytes = 12;
constexpr std::size_t chunk_header_bytes = 8;

std::uint32_t little_endian_u32(std::span<const std::uint8_t> bytes, std::size_t at) {
    return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8U |
           static_cast<std::uint32_t>(bytes[at + 2]) << 16U |
           static_cast<std::uint32_t>(bytes[at + 3]) << 24U;
}

/// "[json.exception.parse_error.101] parse error at line 1 ..." without the bracket.
std::string without_exception_id(const std::string& what) {
    const std::size_t end = what.find("] ");
    return end == std::string::npos ? what : what.substr(end + 2);
}

/// Bounds depth and tokens before a tree is built, and refuses keys that are given twice, of which
/// the tree would have the last. The parser's own callback cannot serve for this:
/// with one it looks through the whole array at the end of each of its objects.
class JsonBounds : public nlohmann::json_sax<Json> {
  public:
    explicit JsonBounds(const std::string& path) : path_(path) {}

    bool null() override { return token(); }
    bool boolean(bool /*value*/) override { return token(); }
    bool number_integer(number_integer_t /*value*/) override { return token(); }
    bool number_unsigned(number_unsigned_t /*value*/) override { return token(); }
    bool number_float(number_float_t /*value*/, const string_t& /*text*/) override {
        return token();
    }
    bool string(string_t& /*value*/) override { return token(); }
    bool binary(binary_t& /*value*/) override { return token(); }
    bool key(string_t& key) override {
        if (!keys_[static_cast<std::size_t>(depth_)].insert(key).second) {
            throw SceneError(path_, plain_message(key), "is given twice in one object of the JSON");
        }
        return token();
    }
    bool start_object(std::size_t /*elements*/) override {
        open();
        keys_[static_cast<std::size_t>(depth_)].clear();
        return true;
    }
    bool start_array(std::size_t /*elements*/) override { return open(); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    /// Who builds the tree says what is wrong.
    bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                     const nlohmann::detail::exception& /*error*/) override {
        return false;
    }

  private:
    bool token() {
        if (++tokens_ > max_json_tokens) {
            throw SceneError(path_, "",
                             fmt::format("JSON with more than {} tokens", max_json_tokens));
        }
        if (depth_ > max_json_depth) {
            throw SceneError(path_, "", fmt::format("JSON nested deeper than {}", max_json_depth));
        }
        return true;
    }

    bool open() {
        token();
        ++depth_;
        keys_.resize(std::max(keys_.size(), static_cast<std::size_t>(depth_) + 1));
        return true;
    }

    bool close() {
        --depth_;
        return token();
    }

    const std::string& path_;
    std::size_t tokens_ = 0;
    int depth_ = 0;
    std::vector<std::unordered_set<std::string>> keys_;  ///< so far, of the object at each depth
};

Json parse_json(const std::string& path, std::span<const std::uint8_t> text) {
    if (const std::string kind = other_file_kind(text); !kind.empty()) {
        throw SceneError(path, "", "not glTF: " + kind);
    }
    JsonBounds bounds(path);
    static_cast<void>(Json::sax_parse(text.begin(), text.end(), &bounds));
    try {
        Json json = Json::parse(text.begin(), text.end());
        if (!json.is_object()) {
            throw SceneError(path, "", "not glTF: the JSON is not an object");
        }
        return json;
    } catch (const Json::exception& error) {
        throw SceneError(path, "",
                         "not glTF: " + plain_message(without_exception_id(error.what())));
    }
}

/// Next chunk of a GLB at `at`, which moves behind it.
struct Chunk {
    std::uint32_t type;
    std::span<const std::uint8_t> bytes;
};

Chunk take_chunk(const std::string& path, std::span<const std::uint8_t> file, std::size_t& at) {
    if (file.size() - at < chunk_header_bytes) {
        throw SceneError(path, "", fmt::format("GLB chunk header at byte {} is cut off", at));
    }
    const std::uint32_t length = little_endian_u32(file, at);
    const std::uint32_t type = little_endian_u32(file, at + 4);
    at += chunk_header_bytes;
    if (length > file.size() - at) {
        throw SceneError(path, "",
                         fmt::format("GLB chunk at byte {} has length {}, but {} bytes are left",
                                     at - chunk_header_bytes, length, file.size() - at));
    }
    const Chunk chunk{type, file.subspan(at, length)};
    at += length;
    return chunk;
}

std::span<const std::uint8_t> checked_glb(const std::string& path,
                                          std::span<const std::uint8_t> file) {
    if (file.size() < glb_header_bytes + chunk_header_bytes) {
        throw SceneError(path, "", "GLB header is cut off");
    }
    if (const std::uint32_t version = little_endian_u32(file, 4); version != 2) {
        throw SceneError(path, "", fmt::format("GLB version {}, only 2 is supported", version));
    }
    const std::uint32_t length = little_endian_u32(file, 8);
    if (length > file.size() || length < glb_header_bytes + chunk_header_bytes) {
        throw SceneError(
            path, "",
            fmt::format("GLB header says {} bytes, the file has {}", length, file.size()));
    }
    return file.first(length);
}

GltfContainer read_glb(const std::string& path, std::span<const std::uint8_t> whole) {
    const std::span<const std::uint8_t> file = checked_glb(path, whole);
    std::size_t at = glb_header_bytes;
    const Chunk text = take_chunk(path, file, at);
    if (text.type != chunk_json) {
        throw SceneError(path, "", "the first GLB chunk is not JSON");
    }
    GltfContainer container{parse_json(path, text.bytes), std::nullopt};
    // Chunks of unknown type are for extensions and are skipped, as the specification demands.
    while (file.size() - at >= chunk_header_bytes) {
        const Chunk chunk = take_chunk(path, file, at);
        if (chunk.type == chunk_binary && !container.binary) {
            container.binary.emplace(chunk.bytes.begin(), chunk.bytes.end());
        }
    }
    return container;
}

}  // namespace

void require_file(const std::string& path, const std::string& scene_file,
                  const std::string& json_path) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error)) {
        const bool there = std::filesystem::exists(path, error);
        throw SceneError(scene_file, json_path,
                         there ? fmt::format("\"{}\" is no file", path)
                               : fmt::format("file \"{}\" not found", path));
    }
}

std::vector<std::uint8_t> read_file_bounded(const std::string& path, std::uint64_t max_bytes,
                                            const std::string& scene_file,
                                            const std::string& json_path) {
    require_file(path, scene_file, json_path);
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    if (error || size > max_bytes) {
        throw SceneError(scene_file, json_path,
                         fmt::format("file \"{}\" is larger than {} bytes", path, max_bytes));
    }
    std::ifstream stream(path, std::ios::binary);
    std::vector<std::uint8_t> bytes(size);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (!stream) {
        throw SceneError(scene_file, json_path, fmt::format("file \"{}\" cannot be read", path));
    }
    return bytes;
}

GltfContainer read_gltf_container(const std::string& path) {
    return parse_gltf_container(path, read_file_bounded(path, max_scene_file_bytes, path, ""));
}

GltfContainer parse_gltf_container(const std::string& path, std::span<const std::uint8_t> file) {
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    const FileMark mark{file.size(), std::hash<std::string_view>()(text)};
    if (file.size() >= 4 && little_endian_u32(file, 0) == glb_magic) {
        GltfContainer container = read_glb(path, file);
        container.mark = mark;
        return container;
    }
    return {parse_json(path, file), std::nullopt, mark};
}

}  // namespace raybundle
