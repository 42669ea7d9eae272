// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/patch_means.h"

namespace raybundle {
namespace {

/// value: of a side.
template <typename Value, typename OfSide>
std::vector<Value> means(const PatchMesh& mesh, const OfSide& value) {
    std::vector<Value> result;
    result.reserve(mesh.patch_count());
    for (std::uint32_t patch = 0; patch < mesh.patch_count(); ++patch) {
        const PatchSides sides = mesh.sides_of(patch);
        if (sides.size() == 1) {
            result.push_back(value(sides.front()));
            continue;
        }
        Value sum(0.0F);
        float area = 0.0F;
        for (const std::uint32_t side : sides) {
            const float own = side_area(mesh, side);
            sum += own * value(side);
            area += own;
        }
        result.push_back(area > 0.0F ? sum / area : value(sides.front()));
    }
    return result;
}

// 14 degrees: a mirror turns rays by twice as much, which is as wide as what is not a mirror.
constexpr float bent_cosine = 0.97F;

/// Twice the area of a side, in the direction of its normal.
glm::vec3 facing_area(const PatchMesh& mesh, std::uint32_t side) {
    const glm::uvec3& t = mesh.triangles[mesh.side_triangle[side]];
    const glm::vec3& a = mesh.positions[t.x];
    const glm::vec3 across = glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
    return side < mesh.triangle_count() ? across : -across;
}

}  // namespace

float side_area(const PatchMesh& mesh, std::uint32_t side) {
    return 0.5F * glm::length(facing_area(mesh, side));
}

glm::vec3 patch_normal(const PatchMesh& mesh, std::uint32_t patch) {
    glm::vec3 sum(0.0F);
    for (const std::uint32_t side : mesh.sides_of(patch)) {
        sum += facing_area(mesh, side);
    }
    const float length = glm::length(sum);
    return length > 0.0F ? sum / length : glm::vec3(0.0F);
}

bool is_bent(const PatchMesh& mesh, std::uint32_t patch) {
    const PatchSides sides = mesh.sides_of(patch);
    if (sides.size() == 1) {
        return false;
    }
    const glm::vec3 mean = patch_normal(mesh, patch);
    for (const std::uint32_t side : sides) {
        const glm::vec3 facing = facing_area(mesh, side);
        if (glm::dot(facing, mean) < bent_cosine * glm::length(facing)) {
            return true;
        }
    }
    return false;
}

std::vector<glm::vec3> patch_means(const PatchMesh& mesh, const std::vector<glm::vec3>& of_sides) {
    return mesh.patch_sets.empty()
               ? of_sides
               : means<glm::vec3>(mesh, [&](std::uint32_t side) { return of_sides[side]; });
}

std::vector<float> patch_means(const PatchMesh& mesh, const std::vector<float>& of_sides) {
    return mesh.patch_sets.empty() || of_sides.empty()
               ? of_sides
               : means<float>(mesh, [&](std::uint32_t side) { return of_sides[side]; });
}

std::vector<glm::vec2> patch_metallic_roughness(const PatchMesh& mesh) {
    if (mesh.metallic_roughness.empty()) {
        return {};
    }
    return means<glm::vec2>(mesh, [&](std::uint32_t side) {
        return mesh.metallic_roughness[mesh.side_triangle[side]];
    });
}

}  // namespace raybundle
