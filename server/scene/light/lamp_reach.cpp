// SPDX-License-Identifier: Apache-2.0
#include "scene/light/lamp_reach.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>

namespace raybundle {

namespace {

/// Directions from a lamp to a sphere: the one to its middle, and the one nearest to the lamp's
/// axis, where most lamps shine brightest.
double brightest(const PlacedLight& lamp, const glm::dvec3& to, double radius) {
    const double distance = glm::length(to);
    const glm::dvec3 axis = lamp.direction();
    if (distance <= radius) {
        return lamp.attenuation(axis);
    }
    const glm::dvec3 middle = to / distance;
    const double cosine = glm::clamp(glm::dot(middle, axis), -1.0, 1.0);
    const double turn = std::min(std::asin(radius / distance), std::acos(cosine));
    const glm::dvec3 across = axis - cosine * middle;
    const double length = glm::length(across);
    const glm::dvec3 nearest =
        length > 0.0 ? std::cos(turn) * middle + std::sin(turn) / length * across : middle;
    return std::max(lamp.attenuation(middle), lamp.attenuation(nearest));
}

}  // namespace

/// At least a tenth of what it sends on the average over all directions, since a lamp may shine
/// beside its axis. Lamps without intensity may be switched on.
float reach_into(const PlacedLight& lamp, float range, const Bounds& box) {
    constexpr float least = 1e-30F;
    constexpr double least_share = 0.1;
    constexpr double beyond_range = 1e-3;
    const glm::dvec3 intensity = lamp.intensity;
    const double strength = std::max({intensity.r, intensity.g, intensity.b});
    if (lamp.kind == PunctualKind::directional) {
        return std::max(static_cast<float>(strength), least);
    }
    const glm::dvec3 to = glm::dvec3(box.centre()) - lamp.position;
    const double square = glm::dot(to, to);
    const double radius = 0.5 * static_cast<double>(glm::length(box.extent()));
    const glm::dvec3 flux = lamp.flux();
    const double mean = std::max({flux.r, flux.g, flux.b}) / (4.0 * glm::pi<double>());
    const double ahead = strength * brightest(lamp, to, radius);
    double result =
        std::max(ahead, least_share * mean) / std::max({square, radius * radius, 1e-12});
    if (range > 0.0F && std::sqrt(square) - radius > static_cast<double>(range)) {
        result *= beyond_range;
    }
    return std::max(static_cast<float>(result), least);
}

NearLamps::NearLamps(std::span<const PlacedLight> lamps, std::span<const float> ranges,
                     const Bounds& bounds)
    : low_(bounds.min), count_(std::min(lamps.size(), most)) {
    constexpr double most_cells = 4096.0;
    const glm::dvec3 extent = glm::max(glm::dvec3(bounds.extent()), glm::dvec3(1e-6));
    const double edge = std::max(std::cbrt(extent.x * extent.y * extent.z / most_cells),
                                 std::max({extent.x, extent.y, extent.z}) / 64.0);
    counts_ = glm::max(glm::ivec3(extent / edge), glm::ivec3(1));
    cells_per_metre_ = glm::dvec3(counts_) / extent;
    const std::size_t cells = static_cast<std::size_t>(counts_.x) *
                              static_cast<std::size_t>(counts_.y) *
                              static_cast<std::size_t>(counts_.z);
    lamps_.resize(cells * count_);
    tbb::parallel_for(std::size_t{0}, cells, [&](std::size_t cell) {
        const auto i = static_cast<int>(cell);
        const glm::dvec3 at(i % counts_.x, i / counts_.x % counts_.y, i / counts_.x / counts_.y);
        Bounds box;
        box.add(glm::vec3(low_ + at / cells_per_metre_));
        box.add(glm::vec3(low_ + (at + 1.0) / cells_per_metre_));
        std::vector<float> reach;
        for (std::size_t k = 0; k < lamps.size(); ++k) {
            reach.push_back(reach_into(lamps[k], ranges[k], box));
        }
        std::vector<std::uint32_t> order(lamps.size());
        std::iota(order.begin(), order.end(), 0U);
        std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count_),
                          order.end(), [&](std::uint32_t a, std::uint32_t b) {
                              return reach[a] > reach[b] || (reach[a] == reach[b] && a < b);
                          });
        std::copy_n(order.begin(), count_,
                    lamps_.begin() + static_cast<std::ptrdiff_t>(cell * count_));
    });
}

std::span<const std::uint32_t> NearLamps::at(const glm::dvec3& place) const {
    const glm::ivec3 cell = glm::ivec3(
        glm::clamp((place - low_) * cells_per_metre_, glm::dvec3(0.0), glm::dvec3(counts_ - 1)));
    const glm::uvec3 at(cell);
    const glm::uvec3 counts(counts_);
    const std::size_t index = at.x + std::size_t{counts.x} * (at.y + std::size_t{counts.y} * at.z);
    return std::span(lamps_).subspan(index * count_, count_);
}

}  // namespace raybundle
