// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/file/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scene/gltf/file/gltf_accessor.h"
#include "scene/gltf/file/gltf_container.h"
#include "scene/gltf/file/gltf_extensions.h"
#include "scene/gltf/file/gltf_image.h"
#include "scene/gltf/file/gltf_schema.h"
#include "scene/gltf/file/gltf_uri.h"
#include "scene/gltf/gltf_air.h"
#include "scene/gltf/gltf_daylight.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/gltf/material/gltf_max_phong.h"

namespace raybundle {
namespace {

constexpr std::size_t max_notices = 100;
// Derived: 25 million vertices, the limit of a scene, with 20 components each (position, normal,
// uv, colour, joints, weights) are 500 million; all of that read twice.
constexpr std::size_t max_components = 1U << 30U;
// Derived: as many bytes as buffers may have.
constexpr std::size_t max_decoded_image_bytes = 2ULL << 30U;
// Derived: tinygltf keeps up to 3 kB of an item, so these are at most 1.5 GB.
constexpr std::size_t max_items = 500'000;

constexpr const char* item_arrays[] = {
    "accessors", "animations", "buffers",  "bufferViews", "cameras", "images",   "materials",
    "meshes",    "nodes",      "samplers", "scenes",      "skins",   "textures",
};

/// Entries of an array; 0 where it is none, which check_schema() complains about.
std::size_t entries(const Json& object, const char* name) {
    const Json* array = object.is_object() ? find_member(object, name) : nullptr;
    return array != nullptr && array->is_array() ? array->size() : 0;
}

/// Nodes, primitives and so on, before anybody walks over them or tinygltf makes objects of them.
void check_item_count(const std::string& path, const Json& json) {
    std::size_t items = 0;
    const auto count = [&](std::size_t more, const std::string& json_path) {
        items += more;
        if (items > max_items) {
            throw SceneError(path, json_path,
                             fmt::format("the file has more than {} nodes, meshes, primitives, "
                                         "accessors, materials and so on together",
                                         max_items));
        }
    };
    for (const char* name : item_arrays) {
        count(entries(json, name), name);
    }
    for (std::size_t i = 0; i < entries(json, "meshes"); ++i) {
        count(entries(json["meshes"][i], "primitives"), item_path("meshes", i) + ".primitives");
    }
}

/// Moves what the model is made from out of the JSON.
tinygltf::Model read_checked_model(const std::string& path, Json& json, Daylight& daylight,
                                   std::optional<Medium>& air, SavedState& saved) {
    check_item_count(path, json);
    check_schema(path, json);
    daylight = read_daylight(path, json);
    air = read_air(path, json);
    saved = read_saved_state(json);
    check_max_phong(path, json);
    // Before any buffer is read: an unreadable extension is the better message than its symptoms.
    check_required_extensions(path, json);
    return read_model(path, json);
}

}  // namespace

GltfDocument::GltfDocument(const std::string& path)
    : GltfDocument(path, read_gltf_container(path)) {}

GltfDocument::GltfDocument(const std::string& path, GltfContainer container)
    : path_(path),
      model_(read_checked_model(path, container.json, daylight_, air_, saved_)),
      extensions_(value_or(container.json, "extensions", Json(Json::object()))),
      animations_(array_or_empty(container.json, "animations")),
      buffers_(path, array_or_empty(container.json, "buffers"), std::move(container.binary),
               model_.bufferViews) {
    check_accessors(*this);
    note_spelling(container.json);
    model_.images = read_images(path, array_or_empty(container.json, "images"));
    note_ignored_extensions(container.json, *this);
}

void GltfDocument::note(const std::string& text) {
    const bool is_new = std::find(notices_.begin(), notices_.end(), text) == notices_.end();
    if (is_new && notices_.size() < max_notices) {
        notices_.push_back(text);
    } else if (is_new && notices_.size() == max_notices) {
        notices_.emplace_back("there are more notices like these");
    }
}

/// Names the files that are spelt otherwise than the scene says.
void GltfDocument::note_spelling(const Json& json) {
    const auto note_file = [&](const std::string& json_path, const std::string& uri) {
        if (const auto found = other_spelling(path_, json_path, uri)) {
            note(
                fmt::format("{}: there is no file \"{}\": \"{}\" is read", json_path, uri, *found));
        }
    };
    const auto note_files = [&](const Json& parent, const std::string& path, const char* name) {
        const Json& list = array_or_empty(parent, name);
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (const Json* uri = find_member(list[i], "uri")) {
                note_file(item_path(path.c_str(), i) + ".uri", uri->get<std::string>());
            }
        }
    };
    note_files(json, "images", "images");
    note_files(json, "buffers", "buffers");
    if (const Json* lights = find_member(extensions_, "EXT_lights_ies")) {
        note_files(*lights, "extensions.EXT_lights_ies.lights", "lights");
    }
    if (daylight_.environment) {
        note_file("extras.raybundle.daylight.environment", *daylight_.environment);
    }
}

void GltfDocument::charge_components(std::size_t count, const std::string& json_path) const {
    components_ += count;
    if (components_ > max_components) {
        fail(json_path, fmt::format("more than {} numbers would be read from the file's accessors",
                                    max_components));
    }
}

void GltfDocument::charge_image(std::size_t bytes, const std::string& json_path) const {
    image_bytes_ += bytes;
    check_image_sum(image_bytes_, json_path);
}

void GltfDocument::check_image_sum(std::size_t bytes, const std::string& json_path) const {
    if (bytes > max_decoded_image_bytes) {
        fail(json_path, fmt::format("decoded images exceed {} bytes", max_decoded_image_bytes));
    }
}

void GltfDocument::fail(const std::string& json_path, const std::string& reason) const {
    throw SceneError(path_, json_path, reason);
}

}  // namespace raybundle
