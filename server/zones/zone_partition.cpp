// SPDX-License-Identifier: Apache-2.0
#include "zones/zone_partition.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "zones/clearly_more.h"
#include "zones/cluster_joins.h"
#include "zones/cluster_parts.h"
#include "zones/patch_clusters.h"

namespace raybundle {

namespace {

constexpr std::size_t max_clusters = 1024;
constexpr std::size_t rays_per_cluster = 32;
constexpr std::size_t most_places = 128;  // that are told apart where rays end

/// Gives each patch to the zone that it exchanges most light with: clusters may have reached under
/// a wall. What loses its light is loose. Zones of patches without rays stay.
void settle_patches(std::span<const ExchangeRay> traced, ZonePartition& partition) {
    const unsigned outside = partition.loose.value_or(0);
    constexpr int max_sweeps = 16;
    std::vector<std::vector<std::pair<std::uint32_t, float>>> partners(partition.zone.size());
    for (const ExchangeRay& ray : traced) {
        if (ray.to != ExchangeRay::lost) {
            partners[ray.from].emplace_back(ray.to, ray.area);
            partners[ray.to].emplace_back(ray.from, ray.area);
        }
    }
    std::vector<float> lost(partition.zone.size(), 0.0F);
    for (const ExchangeRay& ray : traced) {
        lost[ray.from] += ray.to == ExchangeRay::lost ? ray.area : 0.0F;
    }
    std::vector<float> votes(partition.count, 0.0F);
    bool moved = true;
    for (int sweep = 0; sweep < max_sweeps && moved; ++sweep) {
        moved = false;
        for (std::size_t i = 0; i < partners.size(); ++i) {
            std::uint32_t best = partition.zone[i];
            for (const auto& [partner, area] : partners[i]) {
                votes[partition.zone[partner]] += area;
            }
            // Lines between patches count at both of their ends.
            votes[outside] += 2.0F * lost[i];
            best = clearly_more(votes[outside], votes[best]) ? outside : best;
            for (const auto& [partner, area] : partners[i]) {
                best = clearly_more(votes[partition.zone[partner]], votes[best])
                           ? partition.zone[partner]
                           : best;
            }
            for (const auto& [partner, area] : partners[i]) {
                votes[partition.zone[partner]] = 0.0F;
            }
            votes[outside] = 0.0F;
            moved = moved || best != partition.zone[i];
            partition.zone[i] = best;
        }
    }
}

/// Zones that have lost all their patches are none.
void renumber(ZonePartition& partition) {
    constexpr std::uint32_t none = 0xffffffffU;
    std::vector<std::uint32_t> number(partition.count, none);
    unsigned count = 0;
    for (std::uint32_t& zone : partition.zone) {
        if (number[zone] == none) {
            number[zone] = count++;
        }
        zone = number[zone];
    }
    const std::uint32_t loose = partition.loose ? number[*partition.loose] : none;
    partition.loose = loose == none ? std::nullopt : std::optional<unsigned>(loose);
    partition.count = std::max(count, 1U);
}

}  // namespace

ZonePartition find_zones(const ExchangeRays& rays, std::span<const ExchangeRay> traced) {
    ZonePartition result;
    result.zone.assign(rays.areas().size(), 0);
    result.count = 1;
    const std::size_t most =
        std::clamp<std::size_t>(traced.size() / rays_per_cluster, 1, max_clusters);
    const PatchLists leaves =
        split_by_sight(cluster_patches(rays, most), cluster_patches(rays, most_places), traced,
                       result.zone.size(), 2 * most);
    std::vector<std::uint32_t> leaf_of(result.zone.size(), 0);
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
        for (const std::uint32_t patch : leaves[i]) {
            leaf_of[patch] = i;
        }
    }
    // What exchanges next to nothing with other surfaces, as facades do, is a zone of its own.
    std::vector<float> sent(leaves.size(), 0.0F);
    std::vector<float> lost(leaves.size(), 0.0F);
    for (const ExchangeRay& ray : traced) {
        sent[leaf_of[ray.from]] += ray.area;
        lost[leaf_of[ray.from]] += ray.to == ExchangeRay::lost ? ray.area : 0.0F;
    }
    constexpr std::uint32_t outside = 0xffffffffU;
    std::vector<std::uint32_t> inner(leaves.size(), outside);
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (sent[i] > 0.0F && lost[i] <= (1.0F - loose_share) * sent[i]) {
            inner[i] = count++;
        }
    }
    std::vector<ClusterRay> cluster_rays;
    for (const ExchangeRay& ray : traced) {
        const std::uint32_t from = inner[leaf_of[ray.from]];
        if (from != outside) {
            const std::uint32_t to = ray.to == ExchangeRay::lost ? outside : inner[leaf_of[ray.to]];
            cluster_rays.push_back({from, to == outside ? ClusterRay::lost : to, ray.area});
        }
    }
    const auto [zones, zone] = join_clusters(count, cluster_rays, max_zones - 1);
    result.count = zones + 1;
    result.loose = zones;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        for (const std::uint32_t patch : leaves[i]) {
            result.zone[patch] = inner[i] == outside ? zones : zone[inner[i]];
        }
    }
    settle_patches(traced, result);
    renumber(result);
    return result;
}

}  // namespace raybundle
