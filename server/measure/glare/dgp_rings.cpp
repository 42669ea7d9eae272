// SPDX-License-Identifier: Apache-2.0
// Mean luminances about the line of sight, whose ratios lighting designers look at.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "measure/glare/dgp_measurement.h"

namespace raybundle {
namespace {

constexpr std::array<double, 3> ring_edges = {10.0, 30.0, 60.0};  // degrees from the view

/// Which ring about the line of sight; 3: beyond all.
std::size_t ring_of(const Gaze& eye, const glm::dvec3& direction) {
    const double cosine = glm::dot(eye.forward, direction);
    std::size_t ring = 0;
    while (ring < ring_edges.size() && cosine < std::cos(glm::radians(ring_edges[ring]))) {
        ++ring;
    }
    return ring;
}

}  // namespace

std::vector<double> DgpMeasurement::ring_luminances(const Gaze& eye, const Picture& picture,
                                                    std::size_t point) const {
    constexpr std::size_t rings = ring_edges.size();
    std::vector<double> light(rings);
    std::vector<double> solid(rings);
    for (std::size_t ring = 0; ring < rings; ++ring) {
        const double inner = ring == 0 ? 1.0 : std::cos(glm::radians(ring_edges[ring - 1]));
        const double outer = std::cos(glm::radians(ring_edges[ring]));
        solid[ring] = 2.0 * std::numbers::pi * (inner - outer);
        for (std::size_t pixel = 0; pixel < Fisheye::pixels; ++pixel) {
            // Rows and rings are zones of the same sphere: their heights say what they share.
            const std::size_t row = pixel / Fisheye::columns;
            const double top = 1.0 - static_cast<double>(row) / Fisheye::rows;
            const double low = std::max(outer, top - 1.0 / Fisheye::rows);
            const double share = std::max(std::min(inner, top) - low, 0.0) * Fisheye::rows;
            light[ring] += share * picture.luminance[pixel] * Fisheye::solid_angle;
        }
    }
    for (const Source& source : seen_[point]) {
        const std::size_t ring = ring_of(eye, source.seen.direction);
        if (ring < rings && source.seen.has_size()) {
            light[ring] += source.seen.mean_illuminance();
        }
    }
    for (std::size_t ring = 0; ring < rings; ++ring) {
        light[ring] /= solid[ring];
    }
    return light;
}

}  // namespace raybundle
