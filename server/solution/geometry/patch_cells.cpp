// SPDX-License-Identifier: Apache-2.0
#include "solution/geometry/patch_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/scene.h"

namespace raybundle {
namespace {

constexpr unsigned coordinate_bits = 13;
constexpr std::uint64_t most_coordinate = (1U << coordinate_bits) - 1U;
constexpr unsigned facing_bits = 3;
constexpr unsigned coarsest_shift = 5;  // the largest cells are so many times twice the smallest

/// The axis that a normal is nearest to, and its sign.
std::uint64_t facing_of(const glm::vec3& normal) {
    const glm::vec3 size = glm::abs(normal);
    const int axis = size.x >= std::max(size.y, size.z) ? 0 : size.y >= size.z ? 1 : 2;
    return 2U * static_cast<unsigned>(axis) + (normal[axis] < 0.0F ? 1U : 0U);
}

/// A place among the smallest cells.
struct CellKey {
    std::uint64_t group;  // object and facing
    std::array<std::uint64_t, 3> at;

    [[nodiscard]] std::uint64_t packed(unsigned shift) const {
        std::uint64_t key = group;
        for (const std::uint64_t coordinate : at) {
            key = key << coordinate_bits | coordinate >> shift;
        }
        return key;
    }
};

}  // namespace

PatchCells::PatchCells(const PatchMesh& mesh) : patches_(mesh.patch_count()) {
    Bounds bounds;
    double all = 0.0;
    std::vector<glm::vec3> centres, normals;
    for (std::size_t i = 0; i < patches_; ++i) {
        const PatchSides sides = mesh.sides_of(static_cast<std::uint32_t>(i));
        glm::vec3 centre(0.0F);
        glm::vec3 moment(0.0F);
        glm::vec3 facing(0.0F);
        float area = 0.0F;
        for (const std::uint32_t side : sides) {
            const glm::uvec3& t = mesh.triangles[mesh.side_triangle[side]];
            const glm::vec3& a = mesh.positions[t.x];
            const glm::vec3 e1 = mesh.positions[t.y] - a;
            const glm::vec3 e2 = mesh.positions[t.z] - a;
            const glm::vec3 across = glm::cross(e1, e2);
            const float own = 0.5F * glm::length(across);
            centre = a + (e1 + e2) / 3.0F;
            moment += own * centre;
            facing += side < mesh.triangle_count() ? across : -across;
            area += own;
        }
        centres.push_back(sides.size() > 1 && area > 0.0F ? moment / area : centre);
        normals.push_back(facing);
        areas_.push_back(area);
        bounds.add(centres.back());
        all += static_cast<double>(areas_.back());
    }
    const double patch_edge =
        std::sqrt(2.0 * all / static_cast<double>(std::max<std::size_t>(patches_, 1)));
    const glm::vec3 extent = patches_ > 0 ? bounds.extent() : glm::vec3(0.0F);
    const float longest = std::max({extent.x, extent.y, extent.z});
    const float edge = std::max({2.0F * static_cast<float>(patch_edge),
                                 longest / static_cast<float>(most_coordinate), 1e-20F});
    std::vector<CellKey> keys(patches_);
    for (std::size_t i = 0; i < patches_; ++i) {
        const std::uint64_t object =
            mesh.vertex_object[mesh.triangles[mesh.triangle_of(static_cast<std::uint32_t>(i))].x];
        keys[i].group = object << facing_bits | facing_of(normals[i]);
        const glm::vec3 at = (centres[i] - bounds.min) / edge;
        for (int k = 0; k < 3; ++k) {
            keys[i].at[k] = std::min(static_cast<std::uint64_t>(at[k]), most_coordinate);
        }
    }
    std::vector<std::uint32_t> members(patches_);  // one patch of each cell of the last level
    for (std::size_t i = 0; i < patches_; ++i) {
        members[i] = static_cast<std::uint32_t>(i);
    }
    std::size_t level_begin = 0;
    for (unsigned shift = 0; shift <= coarsest_shift; ++shift) {
        const auto key_of = [&](std::uint32_t patch) { return keys[patch].packed(shift); };
        std::vector<std::uint32_t> order(members.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            order[i] = static_cast<std::uint32_t>(i);
        }
        std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return key_of(members[a]) < key_of(members[b]);
        });
        parents_.resize(areas_.size(), none);
        const std::size_t first = areas_.size();
        std::vector<std::uint32_t> next;
        for (std::size_t i = 0; i < order.size(); ++i) {
            const std::uint32_t patch = members[order[i]];
            if (i == 0 || key_of(patch) != key_of(members[order[i - 1]])) {
                next.push_back(patch);
                areas_.push_back(0.0F);
            }
            parents_[level_begin + order[i]] = static_cast<std::uint32_t>(areas_.size() - 1);
            areas_.back() += areas_[level_begin + order[i]];
        }
        level_begin = first;
        members = std::move(next);
    }
    parents_.resize(areas_.size(), none);
}

std::vector<glm::vec3> PatchCells::spread(std::span<const glm::dvec3> flux,
                                          std::span<const std::uint32_t> met,
                                          std::uint64_t least) const {
    std::vector<glm::dvec3> density(flux.begin(), flux.end());
    std::vector<std::uint64_t> count(met.begin(), met.end());
    density.resize(areas_.size(), glm::dvec3(0.0));
    count.resize(areas_.size(), 0);
    for (std::size_t i = 0; i < areas_.size(); ++i) {
        if (parents_[i] != none) {
            density[parents_[i]] += density[i];
            count[parents_[i]] += count[i];
        }
    }
    // From the largest cells down: what is not divided has one density throughout.
    for (std::size_t i = areas_.size(); i-- > 0;) {
        const std::uint32_t parent = parents_[i];
        if (parent == none || count[parent] >= least) {
            density[i] /= static_cast<double>(std::max(areas_[i], 1e-30F));
        } else {
            density[i] = density[parent];
            count[i] = 0;
        }
    }
    std::vector<glm::vec3> spread(patches_);
    for (std::size_t i = 0; i < patches_; ++i) {
        spread[i] = glm::vec3(density[i] * static_cast<double>(areas_[i]));
    }
    return spread;
}

}  // namespace raybundle
