// SPDX-License-Identifier: Apache-2.0
#include "zones/cluster_parts.h"

#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "scene/disjoint_sets.h"

namespace raybundle {

namespace {

constexpr std::uint32_t nothing = 0xffffffffU;  // is what a patch sees whose rays are all lost

/// What the lines of each patch, rays from it and to it, say.
struct Sight {
    std::vector<std::vector<std::uint32_t>> seen;  ///< places where lines end, by patch
    std::vector<std::uint32_t> lost;               ///< lines that leave the scene, by patch
    DisjointSets connected;                        ///< patches, by lines
    std::vector<std::uint32_t> lines_of;           ///< by set of connected patches
    bool dense = false;                            ///< lines enough to connect what is connected

    [[nodiscard]] std::size_t lines(std::uint32_t patch) const {
        return seen[patch].size() + lost[patch];
    }
};

/// Lines that tell a set of connected patches from those that chance has not connected.
constexpr std::uint32_t min_connected_lines = 64;

/// Whether patches all of whose lines are lost are more than chance explains, where the lines of
/// the cluster are lost alike.
bool some_lie_outside(const std::vector<std::uint32_t>& cluster, const Sight& sight) {
    double lost = 0.0;
    double all = 0.0;
    double found = 0.0;
    for (const std::uint32_t patch : cluster) {
        lost += static_cast<double>(sight.lost[patch]);
        all += static_cast<double>(sight.lines(patch));
        found += sight.seen[patch].empty() && sight.lost[patch] > 0 ? 1.0 : 0.0;
    }
    double expected = 0.0;
    for (const std::uint32_t patch : cluster) {
        const auto n = static_cast<double>(sight.lines(patch));
        expected += n > 0.0 ? std::pow(lost / all, n) : 0.0;
    }
    constexpr double more = 1.5;
    constexpr double sure = 3.0;  // standard deviations
    return found > more * expected + sure * std::sqrt(expected);
}

/// Whether lines of a part that end nowhere where others of its cluster do are no chance: if both
/// saw all places alike, no place would be common with a probability of exp(-part * others/places).
bool is_apart(std::size_t part, std::size_t others, std::size_t places) {
    constexpr double sure = 14.0;  // one in a million
    return others == 0 || static_cast<double>(part) * static_cast<double>(others) >=
                              sure * static_cast<double>(places);
}

/// Patches of a cluster by what they see; in the order of their first patches. `unknown` takes
/// those of which lines tell too little.
PatchLists parts_of(const std::vector<std::uint32_t>& cluster, Sight& sight,
                    std::vector<std::uint32_t>& unknown) {
    DisjointSets sets(cluster.size());
    std::map<std::uint32_t, std::uint32_t> first_at;  // place -> the first patch that sees it
    const bool outside = some_lie_outside(cluster, sight);
    std::size_t lines = 0;
    std::vector<bool> known(cluster.size(), false);
    for (std::uint32_t i = 0; i < cluster.size(); ++i) {
        const std::vector<std::uint32_t>& places = sight.seen[cluster[i]];
        known[i] = !places.empty() || (outside && sight.lost[cluster[i]] > 0);
        lines += known[i] ? sight.lines(cluster[i]) : 0;
        if (places.empty() && known[i]) {
            sets.join(first_at.emplace(nothing, i).first->second, i);
        }
        for (const std::uint32_t place : places) {
            sets.join(first_at.emplace(place, i).first->second, i);
        }
    }
    std::vector<std::size_t> lines_of(cluster.size(), 0);
    for (std::uint32_t i = 0; i < cluster.size(); ++i) {
        lines_of[sets.find(i)] += known[i] ? sight.lines(cluster[i]) : 0;
    }
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> part_of;
    PatchLists parts;
    for (std::uint32_t i = 0; i < cluster.size(); ++i) {
        const std::uint32_t set = sets.find(i);
        bool told = known[i] && is_apart(lines_of[set], lines - lines_of[set], first_at.size());
        std::uint32_t component = nothing;
        if (told && sight.dense && !sight.seen[cluster[i]].empty()) {
            component = sight.connected.find(cluster[i]);
            told = sight.lines_of[component] >= min_connected_lines;
        }
        if (!told) {
            unknown.push_back(cluster[i]);
            continue;
        }
        const auto [part, is_new] =
            part_of.emplace(std::pair(set, component), static_cast<std::uint32_t>(parts.size()));
        if (is_new) {
            parts.emplace_back();
        }
        parts[part->second].push_back(cluster[i]);
    }
    return parts;
}

/// Gives patches of a cluster of which too little is known, which is no sign that they lie outside,
/// to the parts of their neighbours.
void add_unknown(const std::vector<std::uint32_t>& unknown, const ExchangeRays& rays,
                 PatchLists& parts) {
    std::vector<std::size_t> sizes;
    for (const std::vector<std::uint32_t>& part : parts) {
        sizes.push_back(part.size());
    }
    for (const std::uint32_t patch : unknown) {
        std::size_t nearest = 0;
        float least = std::numeric_limits<float>::infinity();
        for (std::size_t part = 0; part < sizes.size(); ++part) {
            for (std::size_t k = 0; k < sizes[part]; ++k) {
                const std::uint32_t other = parts[part][k];
                const glm::vec3 way = rays.centres()[other] - rays.centres()[patch];
                const float facing = glm::dot(rays.normals()[other], rays.normals()[patch]);
                // Those that face elsewhere count only where no others are.
                const float distance = glm::dot(way, way) + (facing > 0.5F ? 0.0F : 1e12F);
                if (distance < least) {
                    least = distance;
                    nearest = part;
                }
            }
        }
        parts[nearest].push_back(patch);
    }
}

}  // namespace

PatchLists split_by_sight(const PatchLists& clusters, const PatchLists& places,
                          const ExchangeRays& rays, std::span<const ExchangeRay> traced,
                          std::size_t most) {
    const std::size_t patches = rays.areas().size();
    std::vector<std::uint32_t> place_of(patches, 0);
    for (std::uint32_t place = 0; place < places.size(); ++place) {
        for (const std::uint32_t patch : places[place]) {
            place_of[patch] = place;
        }
    }
    Sight sight{.seen = std::vector<std::vector<std::uint32_t>>(patches),
                .lost = std::vector<std::uint32_t>(patches, 0),
                .connected = DisjointSets(patches),
                .lines_of = std::vector<std::uint32_t>(patches, 0),
                .dense = traced.size() >= patches};
    for (const ExchangeRay& ray : traced) {
        if (ray.to == ExchangeRay::lost) {
            ++sight.lost[ray.from];
            continue;
        }
        sight.connected.join(ray.from, ray.to);
        sight.seen[ray.from].push_back(place_of[ray.to]);
        sight.seen[ray.to].push_back(place_of[ray.from]);
    }
    for (std::uint32_t patch = 0; patch < patches; ++patch) {
        sight.lines_of[sight.connected.find(patch)] +=
            static_cast<std::uint32_t>(sight.seen[patch].size());
    }
    PatchLists result;
    std::size_t left = clusters.size();
    for (const std::vector<std::uint32_t>& cluster : clusters) {
        --left;
        std::vector<std::uint32_t> unknown;
        PatchLists parts = parts_of(cluster, sight, unknown);
        if (parts.size() <= 1 || result.size() + parts.size() + left > most) {
            result.push_back(cluster);
            continue;
        }
        add_unknown(unknown, rays, parts);
        for (std::vector<std::uint32_t>& part : parts) {
            result.push_back(std::move(part));
        }
    }
    return result;
}

}  // namespace raybundle
