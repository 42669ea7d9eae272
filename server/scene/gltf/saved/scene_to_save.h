// SPDX-License-Identifier: Apache-2.0
// Saving a scene as it has been edited, as a GLB file that holds all it needs.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf/saved/scene_source.h"
#include "scene/scene.h"

namespace raybundle {

/// Triangles of one object, in its space, with vertices of their own.
struct ObjectGeometry {
    std::vector<Vertex> vertices;
    std::vector<Triangle> triangles;
};

/// What saving a scene needs to know of it: without textures, and of triangles only those of
/// objects that its file does not have as such.
struct SceneToSave {
    std::string path;
    std::shared_ptr<const SceneSource> source;
    std::shared_ptr<const SceneFolder> folder;
    std::vector<Object> objects;
    std::vector<Material> materials;
    std::vector<Light> lights;
    std::vector<PunctualLight> punctual_lights;
    std::optional<SkyLight> sky_light;
    std::optional<DaylightSetting> daylight;  ///< once it has been set
    bool daylight_dimmed = false;
    std::optional<Medium> medium;
    glm::dvec3 origin{0.0};
    std::vector<SavedLightingScene> lighting_scenes;
    std::map<std::size_t, ObjectGeometry> geometry;  ///< by index into objects

    /// Whether the only node with geometry was divided into parts, some of which have been changed.
    [[nodiscard]] bool parts_apart() const;
    [[nodiscard]] bool divided() const;
    /// Whether a file's object has been moved.
    [[nodiscard]] bool moved(std::size_t object) const;
    /// The object whose triangles an object has: itself, or what it is a copy of.
    [[nodiscard]] std::size_t geometry_of(std::size_t object) const;
};

/// Of the scene as it is now. Takes a look at each triangle. lighting_scenes: those that there are.
SceneToSave scene_to_save(const Scene& scene, std::vector<SavedLightingScene> lighting_scenes);

struct SavedFile {
    std::string bytes;
    std::vector<std::string> notes;  ///< what could not be saved, in words
};

/// Reads the scene's file again and writes it with what has been changed since. What the loader
/// does not read stays as it is. Any thread. Throws SceneError: of a scene that was made by no
/// file, of one whose file has become another one, of photometric files that are gone.
SavedFile save_scene(const SceneToSave& scene);

}  // namespace raybundle
