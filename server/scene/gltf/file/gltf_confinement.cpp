// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/file/gltf_confinement.h"

#include <filesystem>
#include <functional>

#include "scene/gltf/file/gltf_container.h"
#include "scene/gltf/file/gltf_uri.h"
#include "scene/gltf/gltf_loader.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;

bool lies_in(const fs::path& file, const fs::path& folder) {
    const fs::path relative = file.lexically_relative(folder);
    return !relative.empty() && *relative.begin() != "..";
}

using VisitUri = std::function<void(const std::string& json_path, const std::string& uri)>;

/// Visits everything in a scene that lies in a file of its own.
void for_each_uri(const Json& value, const std::string& json_path, const VisitUri& visit) {
    for (const auto& [key, member] : value.items()) {
        const std::string path = value.is_array()
                                     ? json_path + "[" + key + "]"
                                     : json_path + (json_path.empty() ? "" : ".") + key;
        const bool names_file =
            key == "uri" || path.ends_with(".extras.raybundle.daylight.environment");
        if (member.is_structured()) {
            for_each_uri(member, path, visit);
        } else if (names_file && member.is_string()) {
            const auto& uri = member.get_ref<const std::string&>();
            if (!uri.starts_with("data:")) {
                visit(path, uri);
            }
        }
    }
}

}  // namespace

void check_confined(const std::string& scene_file) {
    const GltfContainer container = read_gltf_container(scene_file);
    try {
        const fs::path folder = fs::canonical(fs::absolute(scene_file).parent_path());
        for_each_uri(container.json, "", [&](const std::string& path, const std::string& uri) {
            if (!lies_in(fs::weakly_canonical(local_file(scene_file, path, uri)), folder)) {
                throw SceneError(scene_file, path, "refers to a file outside the scene's folder");
            }
        });
    } catch (const fs::filesystem_error& error) {
        throw SceneError(scene_file, "", error.code().message());
    }
}

std::vector<std::string> files_of_scene(const std::string& scene_file) {
    std::vector<std::string> files{scene_file};
    const GltfContainer container = read_gltf_container(scene_file);
    for_each_uri(container.json, "", [&](const std::string& path, const std::string& uri) {
        files.push_back(local_file(scene_file, path, uri));
    });
    return files;
}

}  // namespace raybundle
