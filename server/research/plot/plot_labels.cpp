// SPDX-License-Identifier: Apache-2.0
#include "research/plot/plot_labels.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace raybundle {
namespace {

/// Labels that touch, placed about the mean of what they wanted.
struct Cluster {
    double centre = 0.0;
    std::size_t count = 0;
};

}  // namespace

std::vector<double> spread_labels(const std::vector<double>& wanted, double spacing, double top,
                                  double bottom) {
    std::vector<std::size_t> order(wanted.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return wanted[a] < wanted[b]; });
    const auto half = [&](const Cluster& c) {
        return 0.5 * spacing * static_cast<double>(c.count - 1);
    };
    // Clusters that would overlap become one, as long as there are any.
    std::vector<Cluster> clusters;
    for (const std::size_t index : order) {
        Cluster next{std::clamp(wanted[index], top, std::max(top, bottom)), 1};
        while (!clusters.empty() && clusters.back().centre + half(clusters.back()) + spacing >
                                        next.centre - half(next)) {
            const Cluster& last = clusters.back();
            const std::size_t count = last.count + next.count;
            next.centre = (last.centre * static_cast<double>(last.count) +
                           next.centre * static_cast<double>(next.count)) /
                          static_cast<double>(count);
            next.count = count;
            next.centre = std::max(std::min(next.centre, bottom - half(next)), top + half(next));
            clusters.pop_back();
        }
        clusters.push_back(next);
    }
    std::vector<double> result(wanted.size());
    std::size_t at = 0;
    for (const Cluster& cluster : clusters) {
        for (std::size_t k = 0; k < cluster.count; ++k) {
            result[order[at++]] = cluster.centre - half(cluster) + spacing * static_cast<double>(k);
        }
    }
    return result;
}

}  // namespace raybundle
