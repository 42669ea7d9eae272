// SPDX-License-Identifier: Apache-2.0
#include "reference/sampling/russian_roulette.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "reference/albedo_tables.h"
#include "reference/sampling/random.h"
#include "reference/sampling/roulette.h"
#include "scene/light/environment.h"

namespace raybundle {
namespace {

/// a^(2 first) + ... + a^(2 (last - 1)).
double sum_of_powers(double albedo, int first, int last) {
    double sum = 0.0;
    for (int i = first; i < last; ++i) {
        sum += std::pow(albedo, 2 * i);
    }
    return sum;
}

/// Sums over the samples of one pixel or of all.
struct WalkSums {
    double count = 0.0;
    double albedo = 0.0;
    double mean_square = 0.0;
    double variance = 0.0;
};

/// Mean over the samples of a pixel, weighted by how many show a reflecting surface.
WalkSums measure_pixel(const RayScene& scene, const AlbedoTables& tables, const CameraRays& camera,
                       std::size_t pixel, std::uint32_t samples, std::uint64_t seed) {
    WalkSums sums;
    double sum = 0.0;
    const glm::dvec2 corner = camera.corner(pixel);
    for (std::uint32_t i = 0; i < samples; ++i) {
        PixelSampler sampler(seed, static_cast<std::uint32_t>(pixel), 0, i);
        const glm::dvec3 direction = camera.direction(corner + sampler.next_pair());
        const auto hit = scene.trace(camera.origin(), direction);
        if (!hit || hit->absorbs()) {
            continue;
        }
        const Scattering scattering(scene, *hit, NormalKind::shading, -direction);
        const std::uint32_t material = scene.mesh().triangle_material[hit->triangle];
        sums.count += 1.0;
        sums.albedo += luminance(glm::vec3(tables.albedo(material, scattering)));
        const glm::dvec2 u = sampler.next_pair();
        const auto next = scattering.sample(u, sampler.next());
        if (!next) {
            continue;
        }
        const auto lit = scene.trace_from(*hit, next->direction);
        const glm::dvec3 emission =
            lit ? scene.emission(*lit) : sky_towards(scene.scene(), next->direction);
        const double alpha = luminance(glm::vec3(next->weight * emission));
        sum += alpha;
        sums.mean_square += alpha * alpha;
    }
    if (sums.count > 1.0) {
        // Unbiased within the pixel, times the number of samples.
        sums.variance =
            std::max((sums.mean_square - sum * sum / sums.count) / (sums.count - 1.0), 0.0) *
            sums.count;
    }
    return sums;
}

}  // namespace

double walk_variance(const WalkStatistics& statistics, double survival, int bounces) {
    const double a = statistics.albedo;
    const double all = sum_of_powers(a, 0, bounces) * statistics.variance;
    double result = all;
    for (int i = 1; i < bounces; ++i) {
        const double later = sum_of_powers(a, bounces - i, bounces) * statistics.mean_square;
        result += std::pow(survival, i) * (all - later) + later * std::pow(survival, i - bounces);
    }
    return result;
}

double optimal_survival(const WalkStatistics& statistics, int bounces) {
    // The curve may have two valleys: look everywhere.
    constexpr int steps = 2000;
    const double least = std::clamp(statistics.albedo, 1e-3, 1.0);
    double best = 1.0;
    double smallest = walk_variance(statistics, best, bounces);
    for (int i = 0; i < steps; ++i) {
        const double survival = least + (1.0 - least) * i / steps;
        const double variance = walk_variance(statistics, survival, bounces);
        if (variance < smallest) {
            smallest = variance;
            best = survival;
        }
    }
    return best;
}

WalkStatistics measure_walks(const RayScene& scene, const CameraRays& camera, std::uint32_t samples,
                             std::uint64_t seed) {
    const AlbedoTables tables(scene.scene());
    std::vector<WalkSums> pixels(std::size_t{camera.size().x} * camera.size().y);
    tbb::parallel_for(std::size_t{0}, pixels.size(), [&](std::size_t pixel) {
        pixels[pixel] = measure_pixel(scene, tables, camera, pixel, samples, seed);
    });
    WalkSums total;
    for (const WalkSums& pixel : pixels) {
        total.count += pixel.count;
        total.albedo += pixel.albedo;
        total.mean_square += pixel.mean_square;
        total.variance += pixel.variance;
    }
    const double count = std::max(total.count, 1.0);
    return {total.albedo / count, total.mean_square / count, total.variance / count};
}

}  // namespace raybundle
