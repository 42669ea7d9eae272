// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/file/gltf_model.h"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

constexpr const char* members_read[] = {
    "accessors", "asset", "bufferViews", "cameras",  "materials", "meshes",
    "nodes",     "scene", "scenes",      "samplers", "skins",     "textures",
};

Json take_members(Json& json) {
    Json taken = Json::object();
    for (const char* name : members_read) {
        if (const auto it = json.find(name); it != json.end()) {
            taken[name] = std::move(*it);
        }
    }
    return taken;
}

/// A view at the end, for the accessors that have none: tinygltf refuses indices without a view,
/// which Draco and sparse accessors do not need.
void add_placeholder_view(Json& json) {
    Json& views = json["bufferViews"];
    const std::size_t placeholder = views.size();
    views.push_back({{"buffer", 0}, {"byteLength", 1}});
    for (Json& accessor : json["accessors"]) {
        accessor.emplace("bufferView", placeholder);
    }
}

void remove_placeholder_view(tinygltf::Model& model) {
    model.bufferViews.pop_back();
    const int placeholder = static_cast<int>(model.bufferViews.size());
    for (tinygltf::Accessor& accessor : model.accessors) {
        if (accessor.bufferView == placeholder) {
            accessor.bufferView = -1;
        }
    }
}

/// Members that tinygltf insists on and nobody reads. What has no perspective becomes an
/// orthographic camera, and what has no field of view one without any: neither is used.
void complete_cameras(Json& json) {
    for (Json& camera : json["cameras"]) {
        if (const auto perspective = camera.find("perspective"); perspective != camera.end()) {
            camera["type"] = "perspective";
            perspective->emplace("znear", 0.0);
            perspective->emplace("yfov", 0.0);
        } else {
            camera["type"] = "orthographic";
            camera["orthographic"] = {{"xmag", 1}, {"ymag", 1}, {"zfar", 1}, {"znear", 0}};
        }
    }
}

void complete_skins(Json& json) {
    for (Json& skin : json["skins"]) {
        skin.emplace("joints", Json::array());
    }
}

/// The text that tinygltf reads.
std::string acceptable_text(Json& json) {
    Json members = take_members(json);
    add_placeholder_view(members);
    complete_cameras(members);
    complete_skins(members);
    return members.dump();
}

}  // namespace

tinygltf::Model read_model(const std::string& file, Json& json) {
    const std::string text = acceptable_text(json);
    if (text.size() > std::numeric_limits<unsigned>::max()) {
        throw SceneError(file, "", fmt::format("{} bytes of JSON are too many", text.size()));
    }
    tinygltf::Model model;
    std::string error;
    std::string warning;
    if (!tinygltf::TinyGLTF().LoadASCIIFromString(&model, &error, &warning, text.data(),
                                                  static_cast<unsigned>(text.size()), "")) {
        error.resize(error.find_last_not_of('\n') + 1);
        throw SceneError(file, "", "tinygltf: " + error);
    }
    remove_placeholder_view(model);
    return model;
}

}  // namespace raybundle
