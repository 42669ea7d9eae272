// SPDX-License-Identifier: Apache-2.0
#include "zones/zone_partition.h"

#include <algorithm>
#include <cmath>
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

/// Where the lines of each zone end, as logarithms of shares: of the zone itself and of the others,
/// the last one that of the lost. What no line has shown may still be as much as half a line.
class ExchangeShares {
  public:
    ExchangeShares(std::span<const ExchangeRay> traced, const ZonePartition& partition)
        : columns_(partition.count + 1), logs_(std::size_t{partition.count} * columns_, 0.0F) {
        std::vector<float> sum(partition.count, 0.0F);
        std::vector<float> squares(partition.count, 0.0F);
        const auto add = [&](std::uint32_t zone, std::uint32_t end, float area) {
            logs_[zone * columns_ + end] += area;
            sum[zone] += area;
            squares[zone] += area * area;
        };
        for (const ExchangeRay& ray : traced) {
            const std::uint32_t from = partition.zone[ray.from];
            const bool lost = ray.to == ExchangeRay::lost;
            const std::uint32_t to = lost ? partition.count : partition.zone[ray.to];
            add(from, to, ray.area);
            if (!lost) {
                add(to, from, ray.area);
            }
        }
        for (std::uint32_t zone = 0; zone < partition.count; ++zone) {
            const float line = sum[zone] > 0.0F ? squares[zone] / sum[zone] : 1.0F;
            for (std::uint32_t end = 0; end < columns_; ++end) {
                float& share = logs_[zone * columns_ + end];
                share = std::log((share + 0.5F * line) /
                                 (sum[zone] + 0.5F * line * static_cast<float>(columns_)));
            }
        }
    }
    [[nodiscard]] float operator()(std::uint32_t zone, std::uint32_t end) const {
        return logs_[zone * columns_ + end];
    }

  private:
    std::size_t columns_;
    std::vector<float> logs_;
};

/// Gives each patch to the zone whose lines end where the patch's lines do, since clusters may
/// reach under a wall. A line through a door says little about a patch, a line to a closed room
/// next door says everything. Zones that lose their light are loose. Patches without rays keep
/// their zone.
void settle_patches(std::span<const ExchangeRay> traced, ZonePartition& partition) {
    const float odds = std::log(20.0F);  // at which a patch changes its zone
    constexpr int max_sweeps = 16;
    const ExchangeShares shares(traced, partition);
    std::vector<std::vector<std::uint32_t>> partners(partition.zone.size());
    for (const ExchangeRay& ray : traced) {
        partners[ray.from].push_back(ray.to);
        if (ray.to != ExchangeRay::lost) {
            partners[ray.to].push_back(ray.from);
        }
    }
    std::vector<std::uint32_t> ends;  // zones where lines of a patch end
    bool moved = true;
    for (int sweep = 0; sweep < max_sweeps && moved; ++sweep) {
        moved = false;
        for (std::size_t i = 0; i < partners.size(); ++i) {
            ends.clear();
            for (const std::uint32_t partner : partners[i]) {
                ends.push_back(partner == ExchangeRay::lost ? partition.count
                                                            : partition.zone[partner]);
            }
            const auto likelihood = [&](std::uint32_t zone) {
                float sum = 0.0F;
                for (const std::uint32_t end : ends) {
                    sum += shares(zone, end);
                }
                return sum;
            };
            std::uint32_t best = partition.zone[i];
            float most = likelihood(best) + odds;
            for (const std::uint32_t end : ends) {
                const std::uint32_t zone =
                    end == partition.count ? partition.loose.value_or(best) : end;
                const float own = zone == best ? most : likelihood(zone);
                if (clearly_more(own, most)) {
                    best = zone;
                    most = own;
                }
            }
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
    const PatchLists leaves = split_by_sight(
        cluster_patches(rays, most), cluster_patches(rays, most_places), rays, traced, 2 * most);
    std::vector<std::uint32_t> leaf_of(result.zone.size(), 0);
    for (std::uint32_t i = 0; i < leaves.size(); ++i) {
        for (const std::uint32_t patch : leaves[i]) {
            leaf_of[patch] = i;
        }
    }
    // What exchanges next to nothing with other surfaces, as facades do, is a zone of its own.
    std::vector<float> sent(leaves.size(), 0.0F);
    std::vector<float> lost(leaves.size(), 0.0F);
    std::vector<bool> met(leaves.size(), false);  // by any ray
    for (const ExchangeRay& ray : traced) {
        sent[leaf_of[ray.from]] += ray.area;
        met[leaf_of[ray.from]] = true;
        if (ray.to == ExchangeRay::lost) {
            lost[leaf_of[ray.from]] += ray.area;
        } else {
            met[leaf_of[ray.to]] = true;
        }
    }
    constexpr std::uint32_t outside = 0xffffffffU;
    std::vector<std::uint32_t> inner(leaves.size(), outside);
    std::uint32_t count = 0;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        if (met[i] && lost[i] <= (1.0F - loose_share) * sent[i]) {
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
    result.cluster = std::move(leaf_of);
    result.clusters = static_cast<unsigned>(leaves.size());
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
