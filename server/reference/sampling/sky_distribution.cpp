// SPDX-License-Identifier: Apache-2.0
#include "reference/sampling/sky_distribution.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/light/environment.h"

namespace raybundle {
namespace {

using std::numbers::pi;
constexpr int rows = 64;  // of equal height on the unit sphere, hence of equal area
constexpr int columns = 128;
constexpr int samples = 4;  // of a cell along each side
constexpr double even_share = 0.1;

/// Unit direction at a place of the sphere; both coordinates in [0, 1].
glm::dvec3 direction_at(double across, double down) {
    const double y = 1.0 - 2.0 * down;
    const double level = std::sqrt(std::max(1.0 - y * y, 0.0));
    return {level * std::cos(2.0 * pi * across), y, level * std::sin(2.0 * pi * across)};
}

double brightest(const Scene& scene, int column, int row) {
    double most = 0.0;
    for (int k = 0; k < samples * samples; ++k) {
        const int kx = k % samples;
        const int ky = k / samples;
        const double x = column + (kx + 0.5) / samples;
        const double y = row + (ky + 0.5) / samples;
        const glm::dvec3 direction = direction_at(x / columns, y / rows);
        most = std::max(most, double{luminance(glm::vec3(sky_towards(scene, direction)))});
    }
    return most;
}

}  // namespace

SkyDistribution::SkyDistribution(const Scene& scene) {
    if (!scene.environment) {
        return;
    }
    std::vector<double> weights;
    double total = 0.0;
    for (int i = 0; i < rows * columns; ++i) {
        weights.push_back(brightest(scene, i % columns, i / columns));
        total += weights.back();
    }
    for (double& weight : weights) {
        weight += even_share * std::max(total, 1e-30) / (rows * columns);
    }
    cells_ = DiscreteDistribution(weights);
}

glm::dvec3 SkyDistribution::sample(double choice, const glm::dvec2& at) const {
    const auto cell = static_cast<int>(cells_.sample(choice));
    const int column = cell % columns;
    const int row = cell / columns;
    return direction_at((column + at.x) / columns, (row + at.y) / rows);
}

double SkyDistribution::density(const glm::dvec3& direction) const {
    const double turns = std::atan2(direction.z, direction.x) / (2.0 * pi);
    const auto column = static_cast<int>((turns - std::floor(turns)) * columns);
    const auto row = static_cast<int>(0.5 * (1.0 - direction.y) * rows);
    const int cell = std::clamp(row, 0, rows - 1) * columns + std::clamp(column, 0, columns - 1);
    return cells_.probability(static_cast<std::size_t>(cell)) * (rows * columns) / (4.0 * pi);
}

}  // namespace raybundle
