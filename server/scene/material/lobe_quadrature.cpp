// SPDX-License-Identifier: Apache-2.0
#include "scene/material/lobe_quadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace raybundle {
namespace {

constexpr int lattice_points = 987;  // a Fibonacci number: the lattice is even
constexpr double golden_ratio = 0.61803398874989485;
using std::numbers::pi;

using Lattice = std::array<DiscPoint, lattice_points>;

/// Even in the polar angle whose sine is the radius: in it directions are smooth up to the rim.
Lattice make_lattice() {
    Lattice points;
    for (int i = 0; i < lattice_points; ++i) {
        const double polar = 0.5 * pi * (i + 0.5) / lattice_points;
        const double turn = (i + 0.5) * golden_ratio;
        const double phi = pi * (turn - std::floor(turn));
        DiscPoint& point = points[static_cast<std::size_t>(i)];
        point.disc = std::sin(polar) * glm::dvec2(std::cos(phi), std::sin(phi));
        point.weight = static_cast<float>(0.5 * pi * std::sin(2.0 * polar) / lattice_points);
    }
    return points;
}

}  // namespace

std::span<const DiscPoint> half_disc_lattice() {
    static const Lattice points = make_lattice();
    return points;
}

LobeAlbedo integrate_albedo(const SpecularLobe& lobe, float cosine) {
    const glm::vec3 w_in = direction_at(cosine);
    // Red shows scale + bias, green the bias alone.
    Brdf brdf{glm::vec3(0.0F), glm::vec3(1.0F, 0.0F, 0.0F), lobe};
    brdf.lobe.f90 = 1.0F;
    brdf.lobe.coat.strength = 0.0F;
    double total = 0.0;
    double bias = 0.0;
    for (const auto& [disc, weight] : half_disc_lattice()) {
        const glm::vec3 w_out = lobe_direction(lobe, w_in, disc);
        const float density = lobe_density(lobe, w_out, w_in);
        if (w_out.z > 0.0F && density > 0.0F) {
            const glm::vec3 f = evaluate(brdf, w_in, w_out, 0.0F);
            total += static_cast<double>(f.r * w_out.z / density * weight);
            bias += static_cast<double>(f.g * w_out.z / density * weight);
        }
    }
    // What quadrature error is left must not reflect more than all light.
    const double excess = std::max(1.0, total);
    return {static_cast<float>((total - bias) / excess), static_cast<float>(bias / excess)};
}

glm::vec3 direction_at(float cosine) {
    const float c = std::max(cosine, 1e-6F);
    return {std::sqrt(std::max(0.0F, 1.0F - c * c)), 0.0F, c};
}

}  // namespace raybundle
