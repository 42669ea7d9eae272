// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_confinement.h"

#include <filesystem>

#include "scene/gltf_container.h"
#include "scene/gltf_loader.h"
#include "scene/gltf_uri.h"

namespace raybundle {
namespace {

namespace fs = std::filesystem;

bool lies_in(const fs::path& file, const fs::path& folder) {
    const fs::path relative = file.lexically_relative(folder);
    return !relative.empty() && *relative.begin() != "..";
}

void check_uris(const Json& value, const std::string& scene_file, const std::string& json_path,
                const fs::path& folder) {
    for (const auto& [key, member] : value.items()) {
        const std::string path = value.is_array()
                                     ? json_path + "[" + key + "]"
                                     : json_path + (json_path.empty() ? "" : ".") + key;
        if (member.is_structured()) {
            check_uris(member, scene_file, path, folder);
        } else if (key == "uri" && member.is_string()) {
            const auto& uri = member.get_ref<const std::string&>();
            if (!uri.starts_with("data:") &&
                !lies_in(fs::weakly_canonical(local_file(scene_file, path, uri)), folder)) {
                throw SceneError(scene_file, path, "refers to a file outside the scene's folder");
            }
        }
    }
}

}  // namespace

void check_confined(const std::string& scene_file) {
    const GltfContainer container = read_gltf_container(scene_file);
    try {
        check_uris(container.json, scene_file, "",
                   fs::canonical(fs::absolute(scene_file).parent_path()));
    } catch (const fs::filesystem_error& error) {
        throw SceneError(scene_file, "", error.code().message());
    }
}

}  // namespace raybundle
