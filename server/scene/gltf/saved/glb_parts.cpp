// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/saved/glb_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "scene/base64.h"
#include "scene/gltf/file/gltf_model.h"
#include "scene/gltf/file/gltf_uri.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/gltf/saved/saved_state.h"

namespace raybundle {
namespace {

constexpr std::uint64_t max_glb_bytes = 2ULL << 30U;  // as GltfContainer's and GltfBuffers'
constexpr std::uint64_t max_embedded_image = 512ULL << 20U;
constexpr std::uint64_t max_embedded_profile = 16ULL << 20U;

constexpr std::size_t alignment = 4;

void pad_to_four(std::vector<std::uint8_t>& bytes) {
    bytes.resize((bytes.size() + alignment - 1) / alignment * alignment);
}

/// By the first bytes; nothing for what is none of them.
std::optional<std::string> image_type(std::span<const std::uint8_t> bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.starts_with("\x89PNG")) {
        return "image/png";
    }
    if (text.starts_with("\xff\xd8\xff")) {
        return "image/jpeg";
    }
    if (text.starts_with("RIFF") && text.size() > 12 && text.substr(8, 4) == "WEBP") {
        return "image/webp";
    }
    return text.starts_with("\xabKTX 20") ? std::optional<std::string>("image/ktx2") : std::nullopt;
}

/// All buffers that have bytes become one, the first; views follow.
class BufferMerger {
  public:
    BufferMerger(GlbParts& parts, std::optional<std::vector<std::uint8_t>> binary)
        : parts_(parts), binary_(std::move(binary)) {}

    void merge() {
        const Json buffers = array_or_empty(parts_.json, "buffers");
        Json placeholders = Json::array();
        for (std::size_t i = 0; i < buffers.size(); ++i) {
            if (auto bytes = bytes_of(buffers[i], i)) {
                pad_to_four(parts_.binary);
                places_.push_back({0, parts_.binary.size()});
                check_size(parts_.binary.size() + bytes->size());
                parts_.binary.insert(parts_.binary.end(), bytes->begin(), bytes->end());
            } else {
                placeholders.push_back(buffers[i]);
                places_.push_back({placeholders.size(), 0});
            }
        }
        pad_to_four(parts_.binary);
        Json merged = Json::array();
        if (!buffers.empty()) {
            merged.push_back(buffers[0].contains("uri") ? Json::object() : buffers[0]);
        }
        merged.insert(merged.end(), placeholders.begin(), placeholders.end());
        parts_.json["buffers"] = std::move(merged);
        if (const auto views = parts_.json.find("bufferViews"); views != parts_.json.end()) {
            for (Json& view : *views) {
                move(view);
                if (const auto extensions = view.find("extensions"); extensions != view.end()) {
                    for (Json& extension : *extensions) {
                        move(extension);
                    }
                }
            }
        }
    }

  private:
    struct Place {
        std::size_t buffer, offset;
    };

    /// Nothing of a buffer that stands for what other bytes decode to.
    std::optional<std::vector<std::uint8_t>> bytes_of(const Json& buffer, std::size_t index) {
        const auto length = buffer.at("byteLength").get<std::size_t>();
        std::vector<std::uint8_t> bytes;
        if (const Json* uri = find_member(buffer, "uri")) {
            bytes = read_uri(parts_.path, item_path("buffers", index) + ".uri",
                             uri->get<std::string>(), max_glb_bytes);
        } else if (index == 0 && binary_) {
            bytes = std::move(*binary_);
        } else {
            return std::nullopt;
        }
        if (bytes.size() < length) {
            throw SceneError(
                parts_.path, item_path("buffers", index),
                fmt::format("holds {} bytes, byteLength says {}", bytes.size(), length));
        }
        bytes.resize(length);
        return bytes;
    }

    void check_size(std::size_t bytes) const {
        if (bytes > max_glb_bytes) {
            throw SceneError(parts_.path, "buffers", fmt::format("exceed {} bytes", max_glb_bytes));
        }
    }

    /// A view, or an extension of it that says where else its bytes are.
    void move(Json& view) const {
        const auto buffer = view.is_object() ? view.find("buffer") : view.end();
        if (!view.is_object() || buffer == view.end() || !buffer->is_number_unsigned() ||
            buffer->get<std::size_t>() >= places_.size()) {
            return;
        }
        const Place& place = places_[buffer->get<std::size_t>()];
        *buffer = place.buffer;
        if (place.offset > 0) {
            view["byteOffset"] = value_or<std::size_t>(view, "byteOffset", 0) + place.offset;
        }
    }

    GlbParts& parts_;
    std::optional<std::vector<std::uint8_t>> binary_;
    std::vector<Place> places_;  // of each buffer
};

void embed_images(GlbParts& parts) {
    const auto images = parts.json.find("images");
    for (std::size_t i = 0; images != parts.json.end() && i < images->size(); ++i) {
        const Json* uri = find_member((*images)[i], "uri");
        if (uri == nullptr) {
            continue;
        }
        const auto bytes = read_uri(parts.path, item_path("images", i) + ".uri",
                                    uri->get<std::string>(), max_embedded_image);
        const std::size_t view = parts.add_view(bytes);
        Json& image = parts.json["images"][i];
        image["bufferView"] = view;
        image["mimeType"] =
            image_type(bytes).value_or(value_or<std::string>(image, "mimeType", "image/png"));
        image.erase("uri");
    }
}

void embed_photometry(GlbParts& parts) {
    const Json::json_pointer path("/extensions/EXT_lights_ies/lights");
    if (!parts.json.contains(path)) {
        return;
    }
    for (std::size_t i = 0; i < parts.json[path].size(); ++i) {
        const Json* uri = find_member(parts.json[path][i], "uri");
        if (uri == nullptr) {
            continue;
        }
        const auto text = uri->get<std::string>();
        const auto bytes =
            read_uri(parts.path, fmt::format("extensions.EXT_lights_ies.lights[{}].uri", i), text,
                     max_embedded_profile);
        const std::size_t view = parts.add_view(bytes);
        Json& light = parts.json[path][i];
        light["bufferView"] = view;
        light["mimeType"] = "application/x-ies-lm-63";
        if (!text.starts_with("data:")) {
            light.emplace("name", percent_decoded(text.substr(text.find_last_of('/') + 1)));
        }
        light.erase("uri");
    }
}

void append_u32(std::string& text, std::size_t value) {
    for (unsigned byte = 0; byte < 4; ++byte) {
        text += static_cast<char>((value >> (8 * byte)) & 0xffU);
    }
}

}  // namespace

std::size_t GlbParts::add(const char* array, Json item) {
    Json& items = json[array];
    items = items.is_null() ? Json::array() : items;
    items.push_back(std::move(item));
    return items.size() - 1;
}

std::size_t GlbParts::add_view(std::span<const std::uint8_t> bytes) {
    pad_to_four(binary);
    const std::size_t offset = binary.size();
    if (offset + bytes.size() > max_glb_bytes) {
        throw SceneError(path, "",
                         fmt::format("with its edits it exceeds {} bytes", max_glb_bytes));
    }
    binary.insert(binary.end(), bytes.begin(), bytes.end());
    Json view = {{"buffer", 0}, {"byteLength", bytes.size()}};
    if (offset > 0) {
        view["byteOffset"] = offset;
    }
    return add("bufferViews", std::move(view));
}

std::size_t GlbParts::add_accessor(std::span<const std::uint8_t> bytes, int component_type,
                                   std::size_t count, const char* type) {
    return add("accessors", {{"bufferView", add_view(bytes)},
                             {"componentType", component_type},
                             {"count", count},
                             {"type", type}});
}

void GlbParts::use(const std::string& extension) {
    Json& used = json["extensionsUsed"];
    used = used.is_null() ? Json::array() : used;
    if (std::find(used.begin(), used.end(), Json(extension)) == used.end()) {
        used.push_back(extension);
    }
}

GlbParts embed(const std::string& path, GltfContainer container) {
    GlbParts parts;
    parts.path = path;
    parts.json = std::move(container.json);
    BufferMerger(parts, std::move(container.binary)).merge();
    embed_images(parts);
    embed_photometry(parts);
    return parts;
}

std::string glb_bytes(GlbParts parts) {
    Json& json = parts.json;
    std::vector<std::uint8_t>& binary = parts.binary;
    pad_to_four(binary);
    if (!binary.empty()) {
        Json& buffers = json["buffers"];
        if (buffers.is_null() || buffers.empty()) {
            buffers = Json::array({Json::object()});
        }
        buffers[0]["byteLength"] = binary.size();
    } else if (json.contains("buffers") && json["buffers"].empty()) {
        json.erase("buffers");
    }
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + alignment - 1) / alignment * alignment, ' ');
    const std::size_t header = 12 + 8 + (binary.empty() ? 0 : 8);
    const std::size_t size = header + text.size() + binary.size();
    if (size > max_glb_bytes) {
        throw SceneError(
            parts.path, "",
            fmt::format("with its edits it has {} bytes; the limit is {}", size, max_glb_bytes));
    }
    std::string file = "glTF";
    file.reserve(size);
    append_u32(file, 2);
    append_u32(file, size);
    append_u32(file, text.size());
    file += "JSON" + text;
    if (!binary.empty()) {
        append_u32(file, binary.size());
        file += std::string("BIN\0", 4);
        file.append(reinterpret_cast<const char*>(binary.data()), binary.size());
    }
    return file;
}

Json& saved_extras(Json& item) {
    Json& extras = item["extras"];
    if (!extras.is_object()) {
        extras = extras.is_null() ? Json::object() : Json{{"value", extras}};
    }
    Json& saved = extras[saved_key];
    saved = saved.is_object() ? saved : Json::object();
    return saved;
}

void drop_saved(Json& item, const char* key) {
    const auto extras = item.find("extras");
    if (extras == item.end() || !extras->is_object() || !extras->contains(saved_key) ||
        !(*extras)[saved_key].is_object()) {
        return;
    }
    Json& saved = (*extras)[saved_key];
    saved.erase(key);
    if (saved.empty()) {
        extras->erase(saved_key);
    }
    if (extras->empty()) {
        item.erase("extras");
    }
}

void drop_extension(Json& item, const char* name) {
    const auto extensions = item.find("extensions");
    if (extensions != item.end() && extensions->is_object()) {
        extensions->erase(name);
        if (extensions->empty()) {
            item.erase("extensions");
        }
    }
}

std::string data_uri(std::span<const std::uint8_t> bytes) {
    return "data:application/octet-stream;base64," +
           base64({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace raybundle
