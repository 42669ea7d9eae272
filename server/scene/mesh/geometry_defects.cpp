// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/geometry_defects.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "scene/contact/point_index.h"

namespace raybundle {
namespace {

constexpr double degenerate_height = 2e-7;

/// Object and point numbers of a triangle, rotated so that the smallest comes first: equal for
/// equal faces of the same orientation.
using FaceKey = std::array<std::uint32_t, 4>;

struct FaceHash {
    std::size_t operator()(const FaceKey& key) const {
        const std::uint64_t low = (std::uint64_t{key[0]} << 32U) | key[1];
        const std::uint64_t high = (std::uint64_t{key[2]} << 32U) | key[3];
        return mix_bits(mix_bits(low) ^ high);
    }
};

FaceKey face_key(const Scene& scene, const Triangle& triangle, PointIndex& points) {
    std::array<std::uint32_t, 3> ids{};
    for (std::size_t k = 0; k < 3; ++k) {
        ids[k] = points.id_of(scene.vertices[triangle.vertex[k]].position);
    }
    std::rotate(ids.begin(), std::min_element(ids.begin(), ids.end()), ids.end());
    return {triangle.object, ids[0], ids[1], ids[2]};
}

}  // namespace

bool is_degenerate(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 ab = b - a;
    const glm::dvec3 ac = c - a;
    const glm::dvec3 bc = c - b;
    const double longest = std::max({glm::dot(ab, ab), glm::dot(ac, ac), glm::dot(bc, bc)});
    // height = |ab x ac| / longest edge
    return !(glm::length(glm::cross(ab, ac)) > degenerate_height * longest);
}

std::size_t remove_duplicate_faces(Scene& scene) {
    PointIndex points;
    std::unordered_set<FaceKey, FaceHash> seen;
    seen.reserve(scene.triangles.size());
    return std::erase_if(scene.triangles, [&](const Triangle& triangle) {
        return !seen.insert(face_key(scene, triangle, points)).second;
    });
}

EdgeDefects count_edge_defects(const Scene& scene) {
    PointIndex points;
    std::unordered_map<FaceKey, std::uint32_t, FaceHash> uses;
    uses.reserve(scene.triangles.size() * 3 / 2);
    for (const Triangle& triangle : scene.triangles) {
        std::array<std::uint32_t, 3> ids{};
        for (std::size_t k = 0; k < 3; ++k) {
            ids[k] = points.id_of(scene.vertices[triangle.vertex[k]].position);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(ids[k], ids[(k + 1) % 3]);
            ++uses[{triangle.object, low, high, 0}];
        }
    }
    EdgeDefects defects;
    for (const auto& [edge, count] : uses) {
        defects.boundary += count == 1 ? 1 : 0;
        defects.non_manifold += count > 2 ? 1 : 0;
    }
    return defects;
}

}  // namespace raybundle
