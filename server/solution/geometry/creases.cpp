// SPDX-License-Identifier: Apache-2.0
#include "solution/geometry/creases.h"

#include <bit>
#include <unordered_map>
#include <utility>

namespace raybundle {

namespace {

constexpr float smallest_cosine = 0.866F;  // of a smooth continuation: 30 degrees

/// Object and bit patterns of a position: equal for vertices at the same place of one object.
struct PointKey {
    std::uint32_t object, x, y, z;
    bool operator==(const PointKey&) const = default;
};

struct PointHash {
    std::size_t operator()(const PointKey& k) const {
        std::uint64_t h = k.object;
        for (const std::uint32_t part : {k.x, k.y, k.z}) {
            h = (h ^ part) * 0x9e3779b97f4a7c15ULL;
            h ^= h >> 29U;
        }
        return h;
    }
};

std::vector<std::uint32_t> weld(const PatchMesh& mesh) {
    std::unordered_map<PointKey, std::uint32_t, PointHash> points;
    std::vector<std::uint32_t> result;
    result.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 p = mesh.positions[i] + 0.0F;  // -0 becomes 0
        const PointKey key{mesh.vertex_object[i], std::bit_cast<std::uint32_t>(p.x),
                           std::bit_cast<std::uint32_t>(p.y), std::bit_cast<std::uint32_t>(p.z)};
        result.push_back(points.try_emplace(key, static_cast<std::uint32_t>(i)).first->second);
    }
    return result;
}

glm::vec3 unit_normal(const PatchMesh& mesh, std::size_t triangle) {
    const glm::uvec3& t = mesh.triangles[triangle];
    const glm::vec3 n = glm::cross(mesh.positions[t.y] - mesh.positions[t.x],
                                   mesh.positions[t.z] - mesh.positions[t.x]);
    const float length = glm::length(n);
    return length > 0.0F ? n / length : glm::vec3(0.0F);
}

}  // namespace

std::vector<std::uint32_t> find_creases(const PatchMesh& mesh) {
    const std::vector<std::uint32_t> point = weld(mesh);
    const auto edge_key = [&](std::size_t triangle, int k) {
        const glm::uvec3& t = mesh.triangles[triangle];
        return std::pair{point[t[(k + 1) % 3]], point[t[(k + 2) % 3]]};
    };
    const auto pack = [](std::uint32_t a, std::uint32_t b) {
        return static_cast<std::uint64_t>(a) << 32U | b;
    };
    struct Edge {
        std::uint32_t triangle = 0;
        bool shared = false;  // by two triangles, in the same direction
    };
    std::unordered_map<std::uint64_t, Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const auto [a, b] = edge_key(i, k);
            const auto [edge, first] =
                edges.try_emplace(pack(a, b), Edge{static_cast<std::uint32_t>(i)});
            edge->second.shared |= !first;
        }
    }
    std::vector<std::uint32_t> creases(mesh.triangles.size(), 0);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::vec3 normal = unit_normal(mesh, i);
        for (int k = 0; k < 3; ++k) {
            const auto [a, b] = edge_key(i, k);
            const auto neighbour = edges.find(pack(b, a));
            const bool smooth =
                neighbour != edges.end() && !neighbour->second.shared &&
                !edges.find(pack(a, b))->second.shared &&
                glm::dot(normal, unit_normal(mesh, neighbour->second.triangle)) >= smallest_cosine;
            creases[i] |= smooth ? 0U : 1U << static_cast<unsigned>(k);
        }
    }
    return creases;
}

}  // namespace raybundle
