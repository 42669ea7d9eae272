// SPDX-License-Identifier: Apache-2.0
#include "zones/cluster_joins.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "zones/clearly_more.h"

namespace raybundle {

namespace {

/// Rays tell the share of its light that a zone keeps, and with it the level, with at most this
/// standard error; few are enough for one that is nearly closed.
constexpr float max_share_error = 1.0F / 128.0F;
constexpr std::uint32_t min_zone_rays = 64;  // that tell such a share at all

bool well_known(float kept_share, std::uint32_t rays) {
    const float variance =
        kept_share * (1.0F - std::min(kept_share, 1.0F)) / static_cast<float>(std::max(rays, 1U));
    return rays >= min_zone_rays && variance <= max_share_error * max_share_error;
}

/// Two clusters, or what they have become, that are one from here on.
struct Join {
    std::uint32_t first = 0, second = 0;  ///< nodes: clusters, then joins in their order
    float share = 0.0F;  ///< of the light of the one that sends less, that goes to the other
    float first_kept = 0.0F, second_kept = 0.0F;  ///< shares of their light that they keep
};

/// Exchange of clusters that are joined step by step, those first that exchange the most light for
/// what they send (average linkage): clusters of one room long before rooms.
class Joiner {
  public:
    explicit Joiner(std::size_t count)
        : count_(count),
          flux_(count * count, 0.0F),
          sent_(count, 0.0F),
          node_(count),
          gone_(count, false),
          best_(count, none),
          best_density_(count, -1.0F) {
        std::iota(node_.begin(), node_.end(), 0U);
    }
    void add(std::uint32_t a, std::uint32_t b, float flux) {
        flux_[a * count_ + b] += flux;
        if (a != b) {
            flux_[b * count_ + a] += flux;
        }
    }
    void add_sent(std::uint32_t a, float flux) { sent_[a] += flux; }
    /// Clusters that no ray starts on send what they receive, by reciprocity.
    void complete_sent() {
        for (std::size_t a = 0; a < count_; ++a) {
            if (sent_[a] > 0.0F) {
                continue;
            }
            for (std::size_t b = 0; b < count_; ++b) {
                sent_[a] += flux_[a * count_ + b];
            }
        }
    }

    std::vector<Join> join_all() {
        std::vector<Join> joins;
        for (std::uint32_t a = 0; a < count_; ++a) {
            find_best(a);
        }
        while (joins.size() + 1 < count_) {
            std::uint32_t a = 0;
            for (std::uint32_t b = 1; b < count_; ++b) {
                a = gone_[a] || clearly_more(best_density_[b], best_density_[a]) ? b : a;
            }
            const std::uint32_t kept = std::min(a, best_[a]);
            const std::uint32_t other = std::max(a, best_[a]);
            const float smaller = std::min(sent_[kept], sent_[other]);
            const float share =
                smaller > 0.0F ? 0.5F * flux_[kept * count_ + other] / smaller : 1.0F;
            joins.push_back(
                {node_[kept], node_[other], share, kept_share(kept), kept_share(other)});
            merge(kept, other);
            node_[kept] = static_cast<std::uint32_t>(count_ + joins.size() - 1);
        }
        return joins;
    }

  private:
    static constexpr std::uint32_t none = 0xffffffffU;

    [[nodiscard]] float density(std::uint32_t a, std::uint32_t b) const {
        const float both = sent_[a] * sent_[b];
        // What sends nothing goes with anything.
        return both > 0.0F ? flux_[a * count_ + b] / both
                           : std::sqrt(std::numeric_limits<float>::max());
    }
    [[nodiscard]] float kept_share(std::uint32_t a) const {
        return sent_[a] > 0.0F ? flux_[a * count_ + a] / sent_[a] : 0.0F;
    }
    void find_best(std::uint32_t a) {
        best_[a] = none;
        best_density_[a] = -1.0F;
        for (std::uint32_t b = 0; b < count_; ++b) {
            if (b != a && !gone_[b] && clearly_more(density(a, b), best_density_[a])) {
                best_[a] = b;
                best_density_[a] = density(a, b);
            }
        }
    }
    void merge(std::uint32_t kept, std::uint32_t gone) {
        gone_[gone] = true;
        best_density_[gone] = -2.0F;
        sent_[kept] += sent_[gone];
        flux_[kept * count_ + kept] += flux_[gone * count_ + gone] + flux_[kept * count_ + gone];
        for (std::uint32_t b = 0; b < count_; ++b) {
            if (b != kept && !gone_[b]) {
                flux_[kept * count_ + b] += flux_[gone * count_ + b];
                flux_[b * count_ + kept] = flux_[kept * count_ + b];
            }
        }
        find_best(kept);
        for (std::uint32_t b = 0; b < count_; ++b) {
            if (b == kept || gone_[b]) {
                continue;
            }
            if (best_[b] == gone || best_[b] == kept) {
                find_best(b);
            } else if (clearly_more(density(b, kept), best_density_[b])) {
                best_[b] = kept;
                best_density_[b] = density(b, kept);
            }
        }
    }

    std::size_t count_;
    std::vector<float> flux_, sent_;
    std::vector<std::uint32_t> node_;
    std::vector<bool> gone_;
    std::vector<std::uint32_t> best_;
    std::vector<float> best_density_;
};

/// Takes the loosest joins apart again, from the last one on, and numbers the zones that are left.
class Cut {
  public:
    /// rays: that start on each cluster.
    Cut(const std::vector<Join>& joins, std::vector<std::uint32_t> rays, unsigned most)
        : joins_(joins), clusters_(rays.size()), rays_(std::move(rays)) {
        if (clusters_ == 0) {
            return;
        }
        for (const Join& join : joins_) {
            rays_.push_back(rays_[join.first] + rays_[join.second]);
        }
        nodes_.push_back(static_cast<std::uint32_t>(rays_.size() - 1));
        while (nodes_.size() < most && split_loosest()) {
        }
    }
    [[nodiscard]] unsigned zones() const { return static_cast<unsigned>(nodes_.size()); }
    /// Zone of each cluster; zones(): too few rays tell it from others.
    [[nodiscard]] std::vector<std::uint32_t> zone_of_clusters() const {
        std::vector<std::uint32_t> zone(rays_.size(), unknown);
        for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
            zone[nodes_[i]] = i;
        }
        for (const auto& [few, sibling] : too_few_) {
            const auto largest =
                std::find(nodes_.begin(), nodes_.end(), largest_zone_below(sibling));
            zone[few] =
                sibling == unknown ? zones() : static_cast<std::uint32_t>(largest - nodes_.begin());
        }
        for (std::size_t node = rays_.size(); node-- > clusters_;) {
            const Join& join = joins_[node - clusters_];
            for (const std::uint32_t part : {join.first, join.second}) {
                zone[part] = zone[part] == unknown ? zone[node] : zone[part];
            }
        }
        zone.resize(clusters_);
        return zone;
    }

  private:
    static constexpr std::uint32_t unknown = 0xffffffffU;

    [[nodiscard]] float share(std::uint32_t node) const {
        return node < clusters_ ? 1.0F : joins_[node - clusters_].share;
    }
    bool split_loosest() {
        const auto loosest =
            std::min_element(nodes_.begin(), nodes_.end(),
                             [&](std::uint32_t a, std::uint32_t b) { return share(a) < share(b); });
        if (share(*loosest) >= loose_share) {
            return false;
        }
        const Join& join = joins_[*loosest - clusters_];
        const bool first_is_small = rays_[join.first] < rays_[join.second];
        const std::uint32_t small = first_is_small ? join.first : join.second;
        const std::uint32_t large = first_is_small ? join.second : join.first;
        *loosest = large;
        const float kept = first_is_small ? join.first_kept : join.second_kept;
        if (well_known(kept, rays_[small]) && kept >= loose_share) {
            nodes_.push_back(small);
        } else {
            // What exchanges any light with the rest goes with most of that.
            too_few_.emplace_back(small, join.share > 0.0F ? large : unknown);
        }
        return true;
    }
    [[nodiscard]] std::uint32_t largest_zone_below(std::uint32_t node) const {
        while (node != unknown && node >= clusters_ &&
               std::find(nodes_.begin(), nodes_.end(), node) == nodes_.end()) {
            const Join& join = joins_[node - clusters_];
            node = rays_[join.first] < rays_[join.second] ? join.second : join.first;
        }
        return node;
    }

    const std::vector<Join>& joins_;
    std::size_t clusters_;
    std::vector<std::uint32_t> rays_, nodes_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>>
        too_few_;  // and their siblings, or unknown
};

}  // namespace

ClusterZones join_clusters(std::size_t clusters, std::span<const ClusterRay> rays, unsigned most) {
    Joiner joiner(clusters);
    std::vector<std::uint32_t> count(clusters, 0);
    for (const ClusterRay& ray : rays) {
        joiner.add_sent(ray.from, ray.area);
        ++count[ray.from];
        if (ray.to != ClusterRay::lost) {
            joiner.add(ray.from, ray.to, ray.area);
        }
    }
    joiner.complete_sent();
    const std::vector<Join> joins = joiner.join_all();
    const Cut cut(joins, std::move(count), most);
    return {cut.zones(), cut.zone_of_clusters()};
}

}  // namespace raybundle
