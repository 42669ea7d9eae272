// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/patch_sets.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "scene/mesh/patch_means.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle {
namespace {

/// Members of the patches of which `of_side` is the numbers.
PatchSets with_members(const PatchMesh& mesh, std::vector<std::uint32_t> of_side,
                       std::size_t fronts, std::size_t count) {
    PatchSets sets;
    sets.first.assign(count + 1, 0);
    for (const std::uint32_t patch : of_side) {
        ++sets.first[patch + 1];
    }
    std::partial_sum(sets.first.begin(), sets.first.end(), sets.first.begin());
    sets.members.resize(of_side.size());
    std::vector<std::uint32_t> next(sets.first.begin(), sets.first.end() - 1);
    for (std::uint32_t side = 0; side < of_side.size(); ++side) {
        sets.members[next[of_side[side]]++] = side;
    }
    for (std::size_t patch = 0; patch < count; ++patch) {
        const auto begin = sets.members.begin() + sets.first[patch];
        const auto end = sets.members.begin() + sets.first[patch + 1];
        std::iter_swap(begin, std::max_element(begin, end, [&](std::uint32_t a, std::uint32_t b) {
                           return side_area(mesh, a) < side_area(mesh, b);
                       }));
    }
    sets.side_patch = std::move(of_side);
    sets.front_count = fronts;
    return sets;
}

}  // namespace

PatchSets make_patch_sets(const PatchMesh& mesh, const std::vector<std::uint32_t>& joined,
                          const std::vector<std::uint32_t>& sets) {
    const std::uint32_t set_count =
        sets.empty() ? 0 : *std::max_element(sets.begin(), sets.end()) + 1;
    if (set_count == sets.size()) {
        return {};
    }
    std::vector<std::uint32_t> set_of(mesh.triangle_count(), PatchMesh::no_patch);
    for (std::size_t i = 0; i < joined.size(); ++i) {
        set_of[joined[i]] = sets[i];
    }
    std::vector<std::uint32_t> of_side(mesh.side_count());
    std::uint32_t count = 0;
    std::size_t fronts = 0;
    for (const bool back : {false, true}) {
        std::vector<std::uint32_t> of_set(set_count, PatchMesh::no_patch);
        for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
            const std::uint32_t side = back ? mesh.back_side[t] : t;
            if (side == PatchMesh::no_patch) {
                continue;
            }
            if (set_of[t] == PatchMesh::no_patch) {
                of_side[side] = count++;
                continue;
            }
            std::uint32_t& patch = of_set[set_of[t]];
            patch = patch == PatchMesh::no_patch ? count++ : patch;
            of_side[side] = patch;
        }
        fronts = back ? fronts : count;
    }
    return with_members(mesh, std::move(of_side), fronts, count);
}

}  // namespace raybundle
