// SPDX-License-Identifier: Apache-2.0
// Objects that are copied, or come from a file, while a scene is being shown.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "scene/gltf/file/gltf_confinement.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/mesh/mesh_growth.h"
#include "scene/scene_folder.h"

namespace raybundle {
namespace {

std::size_t added_objects(const Scene& scene) {
    return static_cast<std::size_t>(
        std::count_if(scene.objects.begin(), scene.objects.end(),
                      [](const Object& object) { return object.added != nullptr; }));
}

/// Of the mesh's patches, for patches of the same size: the longest edge of triangles whose areas
/// have this mean, m. Triangles that are bisected down to an edge e have areas round 0.19 e².
float patch_edge(const Scene& scene, const PatchMesh& mesh) {
    constexpr double area_by_edge = 0.19;
    double area = 0.0;
    for (const std::uint32_t triangle : mesh.side_triangle) {
        const glm::uvec3& t = mesh.triangles[triangle];
        const glm::mat3 world(scene.objects[mesh.vertex_object[t.x]].placement());
        const glm::vec3 a = world * (mesh.positions[t.y] - mesh.positions[t.x]);
        const glm::vec3 b = world * (mesh.positions[t.z] - mesh.positions[t.x]);
        area += 0.5 * static_cast<double>(glm::length(glm::cross(a, b)));
    }
    const auto patches = static_cast<double>(std::max<std::size_t>(mesh.patch_count(), 1));
    return static_cast<float>(std::sqrt(std::max(area / patches, 1e-8) / area_by_edge));
}

/// The same scene with all of it in one object, in the world's space.
Scene as_one_object(Scene scene) {
    std::vector<Vertex> vertices;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;  // object, vertex
    Object one;
    for (Triangle& triangle : scene.triangles) {
        const glm::mat4 world = scene.objects[triangle.object].placement();
        const glm::mat3 m(world);
        const glm::mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                                  glm::cross(m[0], m[1]));
        for (std::uint32_t& corner : triangle.vertex) {
            const auto [found, is_new] =
                known.try_emplace({triangle.object, corner}, vertices.size());
            if (is_new) {
                Vertex vertex = scene.vertices[corner];
                vertex.position = glm::vec3(world * glm::vec4(vertex.position, 1.0F));
                vertex.normal = glm::normalize(cofactors * vertex.normal);
                one.bounds.add(vertex.position);
                vertices.push_back(vertex);
            }
            corner = found->second;
        }
        if (glm::determinant(m) < 0.0F) {
            std::swap(triangle.vertex[1], triangle.vertex[2]);
        }
        triangle.object = 0;
    }
    one.id = 1;
    scene.objects = {one};
    scene.vertices = std::move(vertices);
    scene.punctual_lights.clear();
    return scene;
}

void shift_textures(Material& material, int by) {
    for (TextureSlot* slot : {&material.base_colour_texture, &material.metallic_roughness_texture,
                              &material.normal_texture, &material.emission_texture}) {
        slot->texture += slot->texture >= 0 ? by : 0;
    }
}

/// Adds the triangles of another scene's only object; returns the object's index.
void append_triangles(const std::vector<Vertex>& vertices, const std::vector<Triangle>& triangles,
                      std::uint32_t first_material, Scene& scene) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    const auto object = static_cast<std::uint32_t>(scene.objects.size());
    scene.vertices.insert(scene.vertices.end(), vertices.begin(), vertices.end());
    for (Triangle triangle : triangles) {
        for (std::uint32_t& corner : triangle.vertex) {
            corner += first;
        }
        triangle.material += first_material;
        triangle.object = object;
        scene.triangles.push_back(triangle);
    }
}

void append_part(PatchMesh part, std::uint32_t first_material, const Scene& scene,
                 PatchMesh& mesh) {
    const auto object = static_cast<std::uint32_t>(scene.objects.size()) - 1;
    std::fill(part.vertex_object.begin(), part.vertex_object.end(), object);
    for (auto* materials : {&part.triangle_material, &part.facet_material}) {
        for (std::uint32_t& material : *materials) {
            material += first_material;
        }
    }
    append(part, scene, mesh);
}

/// One that is not there yet.
Object new_object(const Scene& scene, Object object, const AddedObject& added) {
    object.id = static_cast<std::uint32_t>(scene.objects.size()) + 1;
    object.name = added.name.empty() ? object.name : added.name;
    object.transform = added.transform;
    object.node = -1;
    object.movable = true;
    object.added = std::make_shared<const AddedObject>(added);
    object.removed = true;
    return object;
}

void copy_object(Scene& scene, PatchMesh& mesh, const AddedObject& added) {
    const std::uint32_t source = added.copy_of - 1;
    std::vector<Vertex> vertices;
    std::vector<Triangle> triangles;
    std::map<std::uint32_t, std::uint32_t> known;
    for (const Triangle& triangle : scene.triangles) {
        if (triangle.object == source) {
            Triangle& copy = triangles.emplace_back(triangle);
            for (std::uint32_t& corner : copy.vertex) {
                const auto [found, is_new] = known.try_emplace(corner, vertices.size());
                if (is_new) {
                    vertices.push_back(scene.vertices[corner]);
                }
                corner = found->second;
            }
        }
    }
    PatchMesh part = part_of(mesh, source);
    append_triangles(vertices, triangles, 0, scene);
    scene.objects.push_back(new_object(scene, scene.objects[source], added));
    append_part(std::move(part), 0, scene, mesh);
}

void add_file(Scene& scene, PatchMesh& mesh, const AddedObject& added) {
    const std::string path = scene.folder->scene_file(added.library);
    check_confined(path);
    Scene file = as_one_object(load_gltf(path, SceneSettings()));
    TessellationSettings settings;
    settings.patch_size = patch_edge(scene, mesh);
    settings.max_patches = max_grown_patches - std::min(mesh.patch_count(), max_grown_patches - 1);
    PatchMesh part = tessellate(file, settings);
    const auto first_material = static_cast<std::uint32_t>(scene.materials.size());
    for (Material material : file.materials) {
        shift_textures(material, static_cast<int>(scene.textures.size()));
        scene.materials.push_back(std::move(material));
    }
    AddedObject of_file = added;
    of_file.materials.assign(scene.materials.begin() + first_material, scene.materials.end());
    scene.textures.insert(scene.textures.end(), std::make_move_iterator(file.textures.begin()),
                          std::make_move_iterator(file.textures.end()));
    append_triangles(file.vertices, file.triangles, first_material, scene);
    Object object = file.objects.front();
    object.name = file.name;
    scene.objects.push_back(new_object(scene, object, of_file));
    append_part(std::move(part), first_material, scene, mesh);
}

}  // namespace

std::string addition_problem(const Scene& scene, const PatchMesh& mesh, const AddedObject& added) {
    if (added_objects(scene) >= max_added_objects) {
        return fmt::format("at most {} objects can be added", max_added_objects);
    }
    if (added.copy_of == 0) {
        return scene.folder ? "" : "library: this server has no folder of scenes";
    }
    if (added.copy_of > scene.objects.size() || scene.objects[added.copy_of - 1].removed) {
        return fmt::format("copyOf: no object {}", added.copy_of);
    }
    std::size_t patches = mesh.patch_count();
    for (const std::uint32_t triangle : mesh.side_triangle) {
        patches += mesh.vertex_object[mesh.triangles[triangle].x] + 1 == added.copy_of ? 1 : 0;
    }
    return patches > max_grown_patches
               ? fmt::format("copyOf: the scene would have more than {} patches", max_grown_patches)
               : "";
}

void add_object(Scene& scene, PatchMesh& mesh, const AddedObject& added) {
    added.copy_of > 0 ? copy_object(scene, mesh, added) : add_file(scene, mesh, added);
}

GrowthMark mark_growth(const Scene& scene) {
    return {scene.vertices.size(), scene.triangles.size(), scene.objects.size(),
            scene.materials.size(), scene.textures.size()};
}

void take_back(Scene& scene, const GrowthMark& mark) {
    scene.vertices.resize(mark.vertices);
    scene.triangles.resize(mark.triangles);
    scene.objects.resize(mark.objects);
    scene.materials.resize(mark.materials);
    scene.textures.resize(mark.textures);
}

}  // namespace raybundle
