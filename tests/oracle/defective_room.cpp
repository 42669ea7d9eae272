// SPDX-License-Identifier: Apache-2.0
#include "defective_room.h"

#include <random>

#include "../unit/gltf_builder.h"
#include "methods.h"

namespace raybundle {
namespace {

using test::GltfBuilder;
using test::Json;

/// Two triangles, front towards cross(u, v).
void add_rectangle(std::vector<glm::vec3>& corners, const glm::vec3& at, const glm::vec3& u,
                   const glm::vec3& v) {
    for (const glm::vec3& p : {at, at + u, at + u + v, at, at + u + v, at + v}) {
        corners.push_back(p);
    }
}

int lambert(GltfBuilder& file, const std::string& name, float albedo) {
    return file.add_material(
        {{"name", name},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {albedo, albedo, albedo, 1.0F}}, {"metallicFactor", 0.0F}}},
         {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0.0F}}}}}});
}

int add_mesh(GltfBuilder& file, const std::vector<glm::vec3>& corners, int material) {
    const int mesh = file.add_triangle_mesh(corners);
    file.json["meshes"][static_cast<std::size_t>(mesh)]["primitives"][0]["material"] = material;
    return mesh;
}

std::vector<glm::vec3> floor_corners(Defect defect, float gap) {
    std::vector<glm::vec3> floor;
    const glm::vec3 at(gap, 0, gap);
    const glm::vec3 x(4 - 2 * gap, 0, 0);
    const glm::vec3 z(0, 0, 5 - 2 * gap);
    if (defect == Defect::t_junctions) {
        add_rectangle(floor, {0, 0, 0}, {0, 0, 5}, {1.7F, 0, 0});
        add_rectangle(floor, {1.7F, 0, 0}, {0, 0, 2.3F}, {2.3F, 0, 0});
        add_rectangle(floor, {1.7F, 0, 2.3F}, {0, 0, 2.7F}, {2.3F, 0, 0});
    } else {
        add_rectangle(floor, at, z, x);
    }
    return floor;
}

std::vector<glm::vec3> slivers() {
    std::vector<glm::vec3> corners;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> inside(0.5F, 2.5F);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 a(inside(random), inside(random), inside(random));
        corners.insert(corners.end(),
                       {a, i % 2 == 0 ? a : a + glm::vec3(0.5F, 0, 0), a + glm::vec3(0.25F, 0, 0)});
    }
    return corners;
}

Scene load(Defect defect) {
    const float gap = defect == Defect::gaps ? 1e-3F : 0.0F;
    GltfBuilder file;
    file.json["extensionsUsed"] = {"KHR_materials_specular", "KHR_materials_emissive_strength"};
    const int walls = lambert(file, "walls", 0.6F);
    const int floor = lambert(file, "floor", 0.6F);
    const int lamp = lambert(file, "lamp", 0.0F);
    file.json["materials"][static_cast<std::size_t>(lamp)]["emissiveFactor"] = {1, 1, 1};
    file.json["materials"][static_cast<std::size_t>(lamp)]["extensions"]
             ["KHR_materials_emissive_strength"] = {{"emissiveStrength", 1000.0F}};
    const glm::vec3 x(4 - 2 * gap, 0, 0);
    const glm::vec3 y(0, 3 - 2 * gap, 0);
    const glm::vec3 z(0, 0, 5 - 2 * gap);
    std::vector<glm::vec3> shell;
    add_rectangle(shell, {gap, 3, gap}, x, z);  // ceiling
    add_rectangle(shell, {gap, gap, 0}, x, y);
    add_rectangle(shell, {gap, gap, 5}, y, x);
    add_rectangle(shell, {0, gap, gap}, y, z);
    std::vector<glm::vec3> wall;  // x = 4, the defective one
    const bool flipped = defect == Defect::flipped_wall;
    add_rectangle(wall, {4, gap, gap}, flipped ? y : z, flipped ? z : y);
    if (defect != Defect::missing_wall) {
        shell.insert(shell.end(), wall.begin(), wall.end());
    }
    if (defect == Defect::duplicate_faces) {
        shell.insert(shell.end(), wall.begin(), wall.end());
    }
    std::vector<glm::vec3> light;
    add_rectangle(light, {1.5F, 2.8F, 2}, {1, 0, 0}, {0, 0, 1});
    Json children = Json::array();
    const auto add_node = [&](const char* name, const std::vector<glm::vec3>& corners,
                              int material) {
        children.push_back(
            file.add_node({{"name", name}, {"mesh", add_mesh(file, corners, material)}}, false));
    };
    add_node("shell", shell, walls);
    add_node("floor", floor_corners(defect, gap), floor);
    add_node("lamp", light, lamp);
    if (defect == Defect::duplicate_object) {
        add_node("wall again", wall, walls);
    }
    if (defect == Defect::slivers) {
        add_node("slivers", slivers(), walls);
    }
    file.add_node({{"children", children}, {"rotation", {0.1, 0.3, 0.2, 0.92736185}}});
    return file.load();
}

}  // namespace

std::string name_of(Defect defect) {
    switch (defect) {
        case Defect::none:
            return "none";
        case Defect::duplicate_faces:
            return "duplicate_faces";
        case Defect::duplicate_object:
            return "duplicate_object";
        case Defect::t_junctions:
            return "t_junctions";
        case Defect::gaps:
            return "gaps";
        case Defect::flipped_wall:
            return "flipped_wall";
        case Defect::missing_wall:
            return "missing_wall";
        case Defect::slivers:
            return "slivers";
    }
    return "unknown";
}

DefectiveRoom::DefectiveRoom(Defect defect) : scene(load(defect)) {
    TessellationSettings settings;
    settings.patch_size = 0.6F;
    mesh = tessellate(scene, settings);
}

double DefectiveRoom::floor_mean(const std::vector<double>& values) const {
    return area_mean(mesh, values, [&](std::size_t patch) {
        const std::uint32_t triangle = mesh.side_triangle[patch];
        return scene.materials[mesh.triangle_material[triangle]].name == "floor";
    });
}

}  // namespace raybundle
