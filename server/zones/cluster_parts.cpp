// SPDX-License-Identifier: Apache-2.0
#include "zones/cluster_parts.h"

#include <map>
#include <utility>

#include "scene/disjoint_sets.h"

namespace raybundle {

namespace {

constexpr std::uint32_t nothing = 0xffffffffU;  // is what a patch sees whose rays are all lost

/// Patches of a cluster by what their rays see; in the order of their first patches.
PatchLists parts_of(const std::vector<std::uint32_t>& cluster,
                    const std::vector<std::vector<std::uint32_t>>& seen, DisjointSets& connected) {
    DisjointSets sets(cluster.size());
    std::map<std::uint32_t, std::uint32_t> first_at;  // place -> the first patch that sees it
    for (std::uint32_t i = 0; i < cluster.size(); ++i) {
        const std::vector<std::uint32_t>& places = seen[cluster[i]];
        if (places.empty()) {
            sets.join(first_at.emplace(nothing, i).first->second, i);
        }
        for (const std::uint32_t place : places) {
            sets.join(first_at.emplace(place, i).first->second, i);
        }
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> part_of;
    PatchLists parts;
    for (std::uint32_t i = 0; i < cluster.size(); ++i) {
        const bool sees = !seen[cluster[i]].empty();
        const auto key = std::pair(sets.find(i), sees ? connected.find(cluster[i]) : nothing);
        const auto [part, is_new] = part_of.emplace(key, static_cast<std::uint32_t>(parts.size()));
        if (is_new) {
            parts.emplace_back();
        }
        parts[part->second].push_back(cluster[i]);
    }
    return parts;
}

}  // namespace

PatchLists split_by_sight(const PatchLists& clusters, const PatchLists& places,
                          std::span<const ExchangeRay> traced, std::size_t patches,
                          std::size_t most) {
    std::vector<std::uint32_t> place_of(patches, 0);
    for (std::uint32_t place = 0; place < places.size(); ++place) {
        for (const std::uint32_t patch : places[place]) {
            place_of[patch] = place;
        }
    }
    DisjointSets connected(patches);
    std::vector<std::vector<std::uint32_t>> seen(patches);
    for (const ExchangeRay& ray : traced) {
        if (ray.to != ExchangeRay::lost) {
            connected.join(ray.from, ray.to);
            seen[ray.from].push_back(place_of[ray.to]);
            seen[ray.to].push_back(place_of[ray.from]);
        }
    }
    PatchLists result;
    std::size_t left = clusters.size();
    for (const std::vector<std::uint32_t>& cluster : clusters) {
        --left;
        PatchLists parts = parts_of(cluster, seen, connected);
        if (result.size() + parts.size() + left > most) {
            result.push_back(cluster);
            continue;
        }
        for (std::vector<std::uint32_t>& part : parts) {
            result.push_back(std::move(part));
        }
    }
    return result;
}

}  // namespace raybundle
