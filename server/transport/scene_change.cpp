// SPDX-License-Identifier: Apache-2.0
#include "transport/scene_change.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>
#include <utility>
#include <vector>

#include "scene/light/environment.h"
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

/// Of a light without extent; a directional one shines at a quarter of a box's surface in the mean.
double flux_over_pi(const PunctualLight& light, int channel, const Bounds& bounds) {
    const glm::dvec3 flux = light.kind == PunctualKind::directional
                                ? 0.25 * box_area(bounds) * glm::dvec3(light.intensity)
                                : place_light(light, glm::mat4(1.0F)).flux();
    return flux[channel] / glm::pi<double>();
}

/// Whether a light has been placed or turned otherwise, or shapes its beam otherwise.
bool shines_elsewhere(const PunctualLight& before, const PunctualLight& after) {
    return before.position != after.position || before.axes != after.axes ||
           before.inner_cosine != after.inner_cosine || before.outer_cosine != after.outer_cosine ||
           before.profile != after.profile;
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

glm::vec3 common_scale(const Scene& scene, const PatchMesh& mesh, const Emission& before,
                       const Emission& after) {
    std::vector<std::pair<std::size_t, double>> emitters;  // patch, area
    for (std::size_t i = 0; i < before.patches.size(); ++i) {
        if (before.patches[i] != glm::vec3(0.0F)) {
            emitters.emplace_back(i, world_area(scene, mesh, i));
        }
    }
    const glm::dvec3 sky_before = before.sky.mean();
    const glm::dvec3 sky_after = after.sky.mean();
    glm::vec3 scale(1.0F);
    std::vector<Share> shares;
    for (int c = 0; c < 3; ++c) {
        shares.clear();
        if (sky_before[c] > 0.0) {
            shares.push_back(
                {sky_after[c] / sky_before[c], sky_before[c] * box_area(scene.bounds)});
        }
        for (const auto& [patch, area] : emitters) {
            const auto old = static_cast<double>(before.patches[patch][c]);
            if (old > 0.0) {
                shares.push_back({static_cast<double>(after.patches[patch][c]) / old, area * old});
            }
        }
        for (std::size_t i = 0; i < before.punctual.size(); ++i) {
            const PunctualLight& light = before.punctual[i];
            const auto old = static_cast<double>(light.intensity[c]);
            if (old > 0.0) {
                shares.push_back({static_cast<double>(after.punctual[i].intensity[c]) / old,
                                  flux_over_pi(light, c, scene.bounds)});
            }
        }
        scale[c] = static_cast<float>(weighted_median(shares));
    }
    return scale;
}

bool sky_left(const Sky& before, const Sky& after, const glm::vec3& scale) {
    constexpr double rounding = 1e-6;  // of a product of two floats, relative
    const auto differ = [&](const glm::dvec3& old, const glm::dvec3& next) {
        return glm::any(
            glm::greaterThan(glm::abs(next - glm::dvec3(scale) * old), rounding * next));
    };
    if (before.environment && after.environment &&
        !after.environment->same_shape(*before.environment)) {
        return true;
    }
    // Skies and grounds of one shape, and images: two directions and the mean tell all.
    const glm::dvec3 up(0.0, 1.0, 0.0);
    return differ(before.mean(), after.mean()) || differ(before.towards(up), after.towards(up)) ||
           differ(before.towards(-up), after.towards(-up));
}

bool anything_left(const Emission& before, const Emission& after, const glm::vec3& scale) {
    constexpr float rounding = 1e-6F;  // of a product of two floats, relative
    const auto differ = [&scale](const glm::vec3& old, const glm::vec3& next) {
        return glm::any(glm::greaterThan(glm::abs(next - scale * old), rounding * next));
    };
    for (std::size_t i = 0; i < before.patches.size(); ++i) {
        if (differ(before.patches[i], after.patches[i])) {
            return true;
        }
    }
    for (std::size_t i = 0; i < before.punctual.size(); ++i) {
        if (differ(before.punctual[i].intensity, after.punctual[i].intensity) ||
            shines_elsewhere(before.punctual[i], after.punctual[i])) {
            return true;
        }
    }
    return sky_left(before.sky, after.sky, scale);
}

}  // namespace raybundle
