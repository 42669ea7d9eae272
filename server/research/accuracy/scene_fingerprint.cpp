// SPDX-License-Identifier: Apache-2.0
#include "research/accuracy/scene_fingerprint.h"

#include <fmt/core.h>

#include <cstdint>
#include <span>
#include <string_view>

#include "scene/gltf/file/gltf_container.h"
#include "scene/gltf/file/gltf_uri.h"

namespace raybundle {
namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{4} << 30U;  // of one file

/// FNV-1a, 64 bits (Fowler, Noll, Vo).
class Hash {
  public:
    void add(std::span<const std::uint8_t> bytes) {
        for (const std::uint8_t byte : bytes) {
            add_word(byte);
        }
        add_word(0x1ffU);  // where one part ends
    }
    void add(std::string_view text) {
        add(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

  private:
    void add_word(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001b3ULL; }

    std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

/// Adds the files that an array of the scene names.
void add_files(const std::string& scene_file, const Json& array, const char* name, Hash& hash) {
    for (const Json& entry : array.is_array() ? array : Json::array()) {
        const bool named = entry.is_object() && entry.contains("uri") && entry["uri"].is_string();
        const std::string uri = named ? entry["uri"].get<std::string>() : "";
        if (!uri.empty() && uri.rfind("data:", 0) != 0) {
            hash.add(read_uri(scene_file, std::string("/") + name, uri, most_bytes));
        }
    }
}

}  // namespace

std::string scene_fingerprint(const std::string& scene_file, const std::string& how) {
    Hash hash;
    hash.add(how);
    hash.add(read_file_bounded(scene_file, most_bytes, scene_file, ""));
    const Json json = read_gltf_container(scene_file).json;
    add_files(scene_file, array_or_empty(json, "buffers"), "buffers", hash);
    add_files(scene_file, array_or_empty(json, "images"), "images", hash);
    if (json.contains("extensions") && json["extensions"].contains("EXT_lights_ies")) {
        const Json& profiles = json["extensions"]["EXT_lights_ies"];
        add_files(scene_file, array_or_empty(profiles, "lights"), "lights", hash);
    }
    for (const Json& scene : array_or_empty(json, "scenes")) {
        const Json::json_pointer environment("/extras/raybundle/daylight/environment");
        if (scene.contains(environment) && scene[environment].is_string()) {
            hash.add(
                read_uri(scene_file, "scenes", scene[environment].get<std::string>(), most_bytes));
        }
    }
    return fmt::format("{:016x}", hash.value());
}

}  // namespace raybundle
