// SPDX-License-Identifier: Apache-2.0
#include "transport/scene_change.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "scene/environment.h"
#include "transport/patch_area.h"

namespace raybundle {
namespace {

/// Emitted flux before, times 1/pi, and what it is multiplied by.
struct Share {
    double ratio = 1.0;
    double flux = 0.0;
};

double box_area(const Bounds& bounds) {
    const glm::dvec3 e = bounds.extent();
    return 2.0 * (e.x * e.y + e.y * e.z + e.z * e.x);
}

/// Of what sum flux |ratio - g| is least at; 1 where that is as good.
double weighted_median(std::vector<Share>& shares) {
    const auto cost = [&shares](double g) {
        double sum = 0.0;
        for (const Share& share : shares) {
            sum += share.flux * std::abs(share.ratio - g);
        }
        return sum;
    };
    std::sort(shares.begin(), shares.end(),
              [](const Share& a, const Share& b) { return a.ratio < b.ratio; });
    double total = 0.0;
    for (const Share& share : shares) {
        total += share.flux;
    }
    double sum = 0.0;
    double best = 1.0;
    for (const Share& share : shares) {
        sum += share.flux;
        if (2.0 * sum >= total) {
            best = share.ratio;
            break;
        }
    }
    return cost(best) < 0.999 * cost(1.0) ? best : 1.0;
}

}  // namespace

glm::vec3 common_scale(const Scene& scene, const PatchMesh& mesh, std::span<const glm::vec3> before,
                       std::span<const glm::vec3> after) {
    if (!scene.punctual_lights.empty()) {
        return glm::vec3(1.0F);  // their share of the solution would be scaled too
    }
    std::vector<std::pair<std::size_t, double>> emitters;  // patch, area
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (before[i] != glm::vec3(0.0F)) {
            emitters.emplace_back(i, world_area(scene, mesh, i));
        }
    }
    glm::vec3 scale(1.0F);
    std::vector<Share> shares;
    for (int c = 0; c < 3; ++c) {
        shares.clear();
        shares.push_back({1.0, mean_sky(scene)[c] * box_area(scene.bounds)});
        for (const auto& [patch, area] : emitters) {
            const auto old = static_cast<double>(before[patch][c]);
            if (old > 0.0) {
                shares.push_back({static_cast<double>(after[patch][c]) / old, area * old});
            }
        }
        scale[c] = static_cast<float>(weighted_median(shares));
    }
    return scale;
}

}  // namespace raybundle
