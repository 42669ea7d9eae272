// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/saved/scene_to_save.h"

#include <algorithm>
#include <set>
#include <unordered_map>
#include <utility>

#include "scene/edit/daylight_edit.h"
#include "scene/mesh/mesh_growth.h"

namespace raybundle {
namespace {

bool same_transform(const Transform& a, const Transform& b) {
    return a.translation == b.translation && a.rotation == b.rotation && a.scale == b.scale;
}

/// Objects whose triangles have to be written.
std::set<std::size_t> objects_to_write(const SceneToSave& scene) {
    std::set<std::size_t> objects;
    const bool parts = scene.parts_apart();
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        const Object& object = scene.objects[i];
        const bool tangled = !object.added && scene.source->entangled[i] && scene.moved(i);
        if (!object.removed && (object.added || parts || tangled)) {
            objects.insert(scene.geometry_of(i));
        }
    }
    return objects;
}

void collect_geometry(const Scene& scene, SceneToSave& result) {
    std::vector<ObjectGeometry*> wanted(scene.objects.size(), nullptr);
    for (const std::size_t object : objects_to_write(result)) {
        wanted[object] = &result.geometry[object];
    }
    if (result.geometry.empty()) {
        return;
    }
    std::unordered_map<std::uint32_t, std::uint32_t> known;  // no two objects share a vertex
    for (const Triangle& triangle : scene.triangles) {
        ObjectGeometry* const geometry = wanted[triangle.object];
        if (geometry == nullptr) {
            continue;
        }
        Triangle& copy = geometry->triangles.emplace_back(triangle);
        for (std::uint32_t& corner : copy.vertex) {
            const auto next = static_cast<std::uint32_t>(geometry->vertices.size());
            const auto [found, is_new] = known.try_emplace(corner, next);
            if (is_new) {
                geometry->vertices.push_back(scene.vertices[corner]);
            }
            corner = found->second;
        }
    }
}

}  // namespace

bool SceneToSave::divided() const {
    return objects.size() > 1 && !objects[1].added && objects[0].node == objects[1].node;
}

bool SceneToSave::moved(std::size_t object) const {
    return object < source->transforms.size() &&
           !same_transform(objects[object].transform, source->transforms[object]);
}

bool SceneToSave::parts_apart() const {
    if (!divided()) {
        return false;
    }
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const bool present = objects[i].added && !objects[i].removed;
        if (present || (!objects[i].added && (objects[i].removed || moved(i)))) {
            return true;
        }
    }
    return false;
}

std::size_t SceneToSave::geometry_of(std::size_t object) const {
    while (objects[object].added && objects[object].added->copy_of > 0) {
        object = objects[object].added->copy_of - 1;
    }
    return object;
}

SceneToSave scene_to_save(const Scene& scene, std::vector<SavedLightingScene> lighting_scenes) {
    SceneToSave result;
    result.path = scene.path;
    result.source = scene.source;
    result.folder = scene.folder;
    result.objects = scene.objects;
    result.materials = scene.materials;
    result.lights = scene.lights;
    result.punctual_lights = scene.punctual_lights;
    result.sky_light = scene.sky_light;
    if (scene.loaded_sky) {
        result.daylight = scene.daylight;
    }
    result.daylight_dimmed = daylight_dimmed(scene);
    result.medium = scene.medium;
    result.origin = scene.origin;
    result.lighting_scenes = std::move(lighting_scenes);
    if (scene.source) {
        collect_geometry(scene, result);
    }
    return result;
}

}  // namespace raybundle
