// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/geometry_defects.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <vector>

#include "scene/contact/point_index.h"

namespace raybundle {
namespace {

constexpr double degenerate_height = 2e-7;

/// Object and point numbers of a triangle, rotated so that the smallest comes first: equal for
/// equal faces of the same orientation.
using FaceKey = std::array<std::uint32_t, 4>;

/// Keys that have come already: an open-addressing hash table.
class SeenFaces {
  public:
    explicit SeenFaces(std::size_t most)
        : slots_(std::bit_ceil(most + most / 3 + 2), none), mask_(slots_.size() - 1) {
        keys_.reserve(most);
    }

    /// Whether a key is new; then it has come from now on.
    bool insert(const FaceKey& key) {
        std::size_t at = hash(key) & mask_;
        for (; slots_[at] != none; at = (at + 1) & mask_) {
            if (keys_[slots_[at]] == key) {
                return false;
            }
        }
        slots_[at] = static_cast<std::uint32_t>(keys_.size());
        keys_.push_back(key);
        return true;
    }

  private:
    static constexpr std::uint32_t none = 0xffffffffU;

    static std::uint64_t hash(const FaceKey& key) {
        const std::uint64_t low = (std::uint64_t{key[0]} << 32U) | key[1];
        const std::uint64_t high = (std::uint64_t{key[2]} << 32U) | key[3];
        return mix_bits(mix_bits(low) ^ high);
    }

    std::vector<std::uint32_t> slots_;
    std::size_t mask_;
    std::vector<FaceKey> keys_;
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

void remove_degenerate_triangles(Scene& scene) {
    std::vector<glm::dmat4> placements;
    for (const Object& object : scene.objects) {
        placements.emplace_back(object.placement());
    }
    std::erase_if(scene.triangles, [&](const Triangle& triangle) {
        glm::dvec3 p[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = glm::dvec3(placements[triangle.object] *
                              glm::dvec4(scene.vertices[triangle.vertex[k]].position, 1.0));
        }
        return is_degenerate(p[0], p[1], p[2]);
    });
}

std::size_t remove_duplicate_faces(Scene& scene) {
    PointIndex points;
    SeenFaces seen(scene.triangles.size());
    return std::erase_if(scene.triangles, [&](const Triangle& triangle) {
        return !seen.insert(face_key(scene, triangle, points));
    });
}

EdgeDefects count_edge_defects(const Scene& scene) {
    std::vector<std::uint32_t> order(scene.triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return scene.triangles[a].object < scene.triangles[b].object;
    });
    EdgeDefects defects;
    std::vector<std::uint64_t> edges;  // of one object
    const auto count = [&] {
        std::sort(edges.begin(), edges.end());
        for (auto first = edges.begin(); first != edges.end();) {
            const auto end = std::find_if(first, edges.end(),
                                          [&](std::uint64_t edge) { return edge != *first; });
            defects.boundary += end - first == 1 ? 1 : 0;
            defects.non_manifold += end - first > 2 ? 1 : 0;
            first = end;
        }
        edges.clear();
    };
    PointIndex points;
    std::uint32_t object = 0;
    for (const std::uint32_t t : order) {
        const Triangle& triangle = scene.triangles[t];
        if (triangle.object != object) {
            count();
            object = triangle.object;
            points = PointIndex();
        }
        std::array<std::uint32_t, 3> ids{};
        for (std::size_t k = 0; k < 3; ++k) {
            ids[k] = points.id_of(scene.vertices[triangle.vertex[k]].position);
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(ids[k], ids[(k + 1) % 3]);
            edges.push_back(std::uint64_t{low} << 32U | high);
        }
    }
    count();
    return defects;
}

}  // namespace raybundle
