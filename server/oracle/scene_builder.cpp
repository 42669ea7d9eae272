// SPDX-License-Identifier: Apache-2.0
#include "oracle/scene_builder.h"

#include <random>
#include <utility>

#include "scene/contact/solid_shells.h"
#include "scene/light/lights.h"

namespace raybundle {

SceneBuilder::SceneBuilder() {
    scene.name = "oracle";
    add_object("room");
}

std::uint32_t SceneBuilder::add_object(const std::string& name, const Transform& transform) {
    Object object;
    object.id = static_cast<std::uint32_t>(scene.objects.size()) + 1;
    object.name = name;
    object.movable = true;
    object.transform = transform;
    scene.objects.push_back(object);
    object_ = object.id - 1;
    return object_;
}

std::uint32_t SceneBuilder::add_material(const glm::vec3& albedo, const glm::vec3& emission) {
    Material material;
    material.base_colour = albedo;
    material.emission = emission;
    material.metallic = 0.0F;
    material.specular = 0.0F;
    return add_material(material);
}

std::uint32_t SceneBuilder::add_material(const Material& material) {
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size()) - 1;
}

void SceneBuilder::add_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c,
                                std::uint32_t material) {
    const auto base = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::mat4 world = scene.objects[object_].world_from_object();
    const glm::vec3 normal = glm::normalize(glm::mat3(transform_) * glm::cross(b - a, c - a));
    for (const glm::vec3& p : {a, b, c}) {
        const glm::vec3 turned(transform_ * glm::vec4(p, 1.0F));
        mesh.positions.push_back(turned);
        mesh.normals.push_back(normal);
        mesh.uvs.emplace_back(0.0F);
        mesh.vertex_object.push_back(object_);
        scene.objects[object_].bounds.add(turned);
        scene.bounds.add(glm::vec3(world * glm::vec4(turned, 1.0F)));
    }
    mesh.triangles.emplace_back(base, base + 1, base + 2);
    mesh.triangle_material.push_back(material);
    mesh.back_side.push_back(PatchMesh::no_patch);
    mesh.side_triangle.push_back(static_cast<std::uint32_t>(mesh.triangles.size()) - 1);
    mesh.base_colour.push_back(scene.materials[material].base_colour);
    mesh.emission.push_back(scene.materials[material].emission);
}

void SceneBuilder::add_quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v,
                            std::uint32_t n, std::uint32_t m, std::uint32_t material) {
    const auto point = [&](std::uint32_t i, std::uint32_t j) {
        return corner + u * (static_cast<float>(i) / static_cast<float>(n)) +
               v * (static_cast<float>(j) / static_cast<float>(m));
    };
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < m; ++j) {
            add_triangle(point(i, j), point(i + 1, j), point(i + 1, j + 1), material);
            add_triangle(point(i, j), point(i + 1, j + 1), point(i, j + 1), material);
        }
    }
}

void SceneBuilder::add_box(const glm::vec3& min, const glm::vec3& max, bool inwards,
                           std::uint32_t n, std::uint32_t material) {
    for (int axis = 0; axis < 3; ++axis) {
        glm::vec3 u(0.0F);
        glm::vec3 v(0.0F);
        const int a = (axis + 1) % 3;
        const int b = (axis + 2) % 3;
        u[a] = max[a] - min[a];
        v[b] = max[b] - min[b];  // cross(u, v) points along +axis
        glm::vec3 high = min;
        high[axis] = max[axis];
        add_quad(min, inwards ? u : v, inwards ? v : u, n, n, material);
        add_quad(high, inwards ? v : u, inwards ? u : v, n, n, material);
    }
}

void SceneBuilder::set_triangle_material(std::size_t triangle, std::uint32_t material) {
    mesh.triangle_material[triangle] = material;
    mesh.base_colour[triangle] = scene.materials[material].base_colour;
    mesh.emission[triangle] = scene.materials[material].emission;
}

glm::vec3 SceneBuilder::cell_centre(std::size_t triangle) const {
    const glm::uvec3& t = mesh.triangles[triangle];
    const glm::vec3 sum = mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z];
    return glm::vec3(glm::inverse(transform_) * glm::vec4(sum / 3.0F, 1.0F));
}

Scene SceneBuilder::loaded_scene() const {
    Scene loaded = scene;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        Triangle triangle;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh.triangles[t][k];
            triangle.vertex[k] = static_cast<std::uint32_t>(loaded.vertices.size());
            triangle.object = mesh.vertex_object[vertex];
            loaded.vertices.push_back({mesh.positions[vertex], mesh.normals[vertex]});
        }
        triangle.material = mesh.triangle_material[t];
        loaded.triangles.push_back(triangle);
    }
    loaded.lights = find_lights(loaded);
    mark_solid_shells(loaded);
    measure_lights(loaded);
    return loaded;
}

void SceneBuilder::join(std::uint32_t size) {
    std::vector<std::uint32_t> all;
    std::vector<std::uint32_t> sets;
    std::uint32_t in_set = 0;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        const bool begins =
            t == 0 || in_set == size || mesh.triangle_material[t] != mesh.triangle_material[t - 1];
        in_set = begins ? 1 : in_set + 1;
        all.push_back(t);
        sets.push_back(t == 0 ? 0U : sets.back() + (begins ? 1U : 0U));
    }
    mesh.patch_sets = make_patch_sets(mesh, all, sets);
}

void SceneBuilder::shuffle(std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    for (std::size_t i = mesh.triangles.size(); i > 1; --i) {
        const std::size_t j = engine() % i;
        std::swap(mesh.triangles[i - 1], mesh.triangles[j]);
        std::swap(mesh.triangle_material[i - 1], mesh.triangle_material[j]);
        std::swap(mesh.base_colour[i - 1], mesh.base_colour[j]);
        std::swap(mesh.emission[i - 1], mesh.emission[j]);
    }
}

}  // namespace raybundle
