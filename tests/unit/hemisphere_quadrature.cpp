// SPDX-License-Identifier: Apache-2.0
#include "hemisphere_quadrature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raybundle::test {
namespace {

using std::numbers::pi;

glm::dvec3 spherical(double cosine, double phi) {
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

/// Directions mirrored by GGX normals; their density per solid angle is D cos_h / (4 |v.h|).
struct MirroredNormals {
    double alpha;
    glm::dvec3 w_in;

    [[nodiscard]] glm::dvec3 direction(double u, double phi) const {
        const glm::dvec3 half =
            spherical(std::sqrt((1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u)), phi);
        return 2.0 * glm::dot(w_in, half) * half - w_in;
    }
    [[nodiscard]] double density(const glm::dvec3& w) const {
        const glm::dvec3 sum = w_in + w;
        const double length = glm::length(sum);
        if (sum.z <= 0.0 || length <= 0.0) {
            return 0.0;
        }
        const glm::dvec3 half = sum / length;
        const double a2 = alpha * alpha;
        const double spread = half.x * half.x + half.y * half.y + a2 * half.z * half.z;
        return a2 * half.z / (pi * spread * spread * 4.0 * glm::dot(w_in, half));
    }
};

/// Directions round the mirrored w_in (which is in the plane y = 0), of density (n+1)/(2 pi) cos^n.
struct PhongLobe {
    double exponent;
    glm::dvec3 w_in;

    [[nodiscard]] glm::dvec3 direction(double u, double phi) const {
        const glm::dvec3 d = spherical(std::pow(1.0 - u, 1.0 / (exponent + 1.0)), phi);
        const glm::dvec3 axis(-w_in.x, 0.0, w_in.z);
        return d.x * glm::dvec3(w_in.z, 0.0, w_in.x) + d.y * glm::dvec3(0, 1, 0) + d.z * axis;
    }
    [[nodiscard]] double density(const glm::dvec3& w) const {
        const double cosine = w_in.z * w.z - w_in.x * w.x;
        return cosine > 0.0 ? (exponent + 1.0) / (2.0 * pi) * std::pow(cosine, exponent) : 0.0;
    }
};

/// Both grids, weighted by the balance heuristic. The rings of a grid are turned against each
/// other: kinks then fall between its points at random.
template <typename Lobe>
glm::dvec3 integrate_with(const Lobe& lobe, const std::function<glm::dvec3(const glm::vec3&)>& g,
                          int points) {
    glm::dvec3 sum(0.0);
    const auto add = [&](const glm::dvec3& w) {
        if (w.z > 0.0) {
            const double density = lobe.density(w) + 1.0 / (4.0 * pi * std::sqrt(w.z));
            sum += g(glm::vec3(w)) / density;
        }
    };
    for (int i = 0; i < points; ++i) {
        const double u = (i + 0.5) / points;
        for (int j = 0; j < points; ++j) {
            const double phi = 2.0 * pi * (j + i * 0.61803398874989485) / points;
            add(spherical(u * u, phi));
            add(lobe.direction(u, phi));
        }
    }
    return sum / (static_cast<double>(points) * points);
}

}  // namespace

glm::dvec3 integrate(const SpecularLobe& lobe, const glm::vec3& w_in,
                     const std::function<glm::dvec3(const glm::vec3&)>& g, int points) {
    const glm::dvec3 in(w_in);
    return lobe.kind == LobeKind::max_phong
               ? integrate_with(PhongLobe{static_cast<double>(lobe.exponent), in}, g, points)
               : integrate_with(MirroredNormals{static_cast<double>(lobe.alpha), in}, g, points);
}

glm::dvec3 albedo_by_quadrature(const Brdf& brdf, float cosine, int points) {
    const glm::vec3 w_in = direction_in_plane(cosine);
    return integrate(
        brdf.lobe, w_in,
        [&](const glm::vec3& w) {
            return glm::dvec3(evaluate(brdf, w_in, w)) * static_cast<double>(w.z);
        },
        points);
}

double importance_by_quadrature(const Brdf& brdf, float cosine, int points) {
    const glm::vec3 w_in = direction_in_plane(cosine);
    const glm::dvec3 mean = albedo_by_quadrature(brdf, cosine, points) / pi;
    return integrate(
               brdf.lobe, w_in,
               [&](const glm::vec3& w) {
                   const glm::dvec3 df = glm::abs(glm::dvec3(evaluate(brdf, w_in, w)) - mean);
                   return glm::dvec3(std::max({df.r, df.g, df.b}) *
                                     std::max(static_cast<double>(w.z), 0.0));
               },
               points)
        .x;
}

glm::vec3 direction_in_plane(float cosine) {
    return {std::sqrt(std::max(0.0F, 1.0F - cosine * cosine)), 0.0F, cosine};
}

}  // namespace raybundle::test
