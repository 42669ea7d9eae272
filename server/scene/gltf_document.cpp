// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scene/gltf_accessor.h"
#include "scene/gltf_container.h"
#include "scene/gltf_daylight.h"
#include "scene/gltf_extensions.h"
#include "scene/gltf_image.h"
#include "scene/gltf_loader.h"
#include "scene/gltf_max_phong.h"
#include "scene/gltf_schema.h"
#include "scene/gltf_uri.h"

namespace raybundle {
namespace {

constexpr std::size_t max_notices = 100;

/// Moves what the model is made from out of the JSON.
tinygltf::Model read_checked_model(const std::string& path, Json& json, Daylight& daylight) {
    check_schema(path, json);
    daylight = read_daylight(path, json);
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
      model_(read_checked_model(path, container.json, daylight_)),
      extensions_(value_or(container.json, "extensions", Json(Json::object()))),
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

void GltfDocument::fail(const std::string& json_path, const std::string& reason) const {
    throw SceneError(path_, json_path, reason);
}

}  // namespace raybundle
