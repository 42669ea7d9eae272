// SPDX-License-Identifier: Apache-2.0
#include "zones/patch_clusters.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "zones/clearly_more.h"

namespace raybundle {

namespace {

constexpr std::size_t max_objects_apart = 4;  // in one cluster

/// Splits patches at the median of their rays, across the longest axis of place and normal.
class Clusters {
  public:
    explicit Clusters(const ExchangeRays& rays, std::size_t most) : rays_(rays) {
        std::vector<std::uint32_t> all(rays.areas().size());
        std::iota(all.begin(), all.end(), 0U);
        split(all, most);
    }
    [[nodiscard]] const std::vector<std::vector<std::uint32_t>>& patches() const { return leaves_; }

  private:
    /// Axis 0 to 2: of the place; 3 to 5: of the normal, whose difference counts as much as a way
    /// across the cluster.
    [[nodiscard]] float coordinate(std::uint32_t patch, int axis) const {
        return axis < 3 ? rays_.centres()[patch][axis] : rays_.normals()[patch][axis - 3];
    }

    [[nodiscard]] int widest(std::span<const std::uint32_t> patches) const {
        double mean[6] = {};
        double square[6] = {};
        double sum = 0.0;
        for (const std::uint32_t patch : patches) {
            const double share = rays_.shares()[patch];
            sum += share;
            for (int axis = 0; axis < 6; ++axis) {
                const auto c = static_cast<double>(coordinate(patch, axis));
                mean[axis] += share * c;
                square[axis] += share * c * c;
            }
        }
        if (sum <= 0.0) {
            return -1;
        }
        double variance[6];
        double size = 0.0;
        for (int axis = 0; axis < 6; ++axis) {
            mean[axis] /= sum;
            variance[axis] = std::max(square[axis] / sum - mean[axis] * mean[axis], 0.0);
            size += axis < 3 ? variance[axis] : 0.0;
        }
        for (int axis = 3; axis < 6; ++axis) {
            variance[axis] *= size;
        }
        int largest = 0;
        for (int axis = 1; axis < 6; ++axis) {
            largest = clearly_more(variance[axis], variance[largest]) ? axis : largest;
        }
        return variance[largest] > 0.0 ? largest : -1;
    }

    /// In steps of the cluster's extent that are coarser than rounding.
    void sort_along(int axis, std::vector<std::uint32_t>& patches) const {
        constexpr float steps = 4096.0F;
        float low = coordinate(patches.front(), axis);
        float high = low;
        for (const std::uint32_t patch : patches) {
            low = std::min(low, coordinate(patch, axis));
            high = std::max(high, coordinate(patch, axis));
        }
        const float scale = high > low ? steps / (high - low) : 0.0F;
        std::vector<std::uint32_t> keys;
        keys.reserve(patches.size());
        for (const std::uint32_t patch : patches) {
            keys.push_back(
                static_cast<std::uint32_t>((coordinate(patch, axis) - low) * scale + 0.5F));
        }
        // Counting, which keeps the order of what is equal.
        std::vector<std::uint32_t> first(static_cast<std::size_t>(steps) + 2, 0);
        for (const std::uint32_t key : keys) {
            ++first[key + 1];
        }
        std::partial_sum(first.begin(), first.end(), first.begin());
        std::vector<std::uint32_t> sorted(patches.size());
        for (std::size_t i = 0; i < patches.size(); ++i) {
            sorted[first[keys[i]]++] = patches[i];
        }
        patches.swap(sorted);
    }

    void split(std::vector<std::uint32_t> patches, std::size_t most) {
        const int axis = most > 1 && patches.size() > 1 ? widest(patches) : -1;
        if (axis < 0) {
            add_by_object(patches);
            return;
        }
        sort_along(axis, patches);
        const std::size_t middle = axis < 3 ? median(patches) : bend(patches, axis);
        double sum = 0.0;
        double first = 0.0;
        for (std::size_t i = 0; i < patches.size(); ++i) {
            sum += rays_.shares()[patches[i]];
            first += i < middle ? rays_.shares()[patches[i]] : 0.0;
        }
        const auto part = std::clamp<std::size_t>(
            static_cast<std::size_t>(std::lround(static_cast<double>(most) * first / sum)), 1,
            most - 1);
        const auto at = patches.begin() + static_cast<std::ptrdiff_t>(middle);
        split({patches.begin(), at}, part);
        split({at, patches.end()}, most - part);
    }

    /// First patch of the second half of the rays; neither part is empty.
    [[nodiscard]] std::size_t median(const std::vector<std::uint32_t>& sorted) const {
        double sum = 0.0;
        for (const std::uint32_t patch : sorted) {
            sum += rays_.shares()[patch];
        }
        double running = 0.0;
        std::size_t middle = 0;
        while (middle + 1 < sorted.size() && (middle == 0 || 2.0 * running < sum)) {
            running += rays_.shares()[sorted[middle++]];
        }
        return middle;
    }

    /// Where normals are half of the way from one extreme to the other: sides of a wall are two.
    [[nodiscard]] std::size_t bend(const std::vector<std::uint32_t>& sorted, int axis) const {
        const float half =
            0.5F * (coordinate(sorted.front(), axis) + coordinate(sorted.back(), axis));
        std::size_t middle = 1;
        while (middle + 1 < sorted.size() && coordinate(sorted[middle], axis) < half) {
            ++middle;
        }
        return middle;
    }

    void add_by_object(const std::vector<std::uint32_t>& patches) {
        std::map<std::uint32_t, std::vector<std::uint32_t>> parts;
        for (const std::uint32_t patch : patches) {
            parts[rays_.objects()[patch]].push_back(patch);
        }
        if (parts.size() > max_objects_apart) {
            leaves_.push_back(patches);
            return;
        }
        for (auto& [object, part] : parts) {
            leaves_.push_back(std::move(part));
        }
    }

    const ExchangeRays& rays_;
    std::vector<std::vector<std::uint32_t>> leaves_;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> cluster_patches(const ExchangeRays& rays,
                                                        std::size_t most) {
    return Clusters(rays, most).patches();
}

}  // namespace raybundle
