// SPDX-License-Identifier: Apache-2.0
// How long a gathering walk should go on: chapter 3.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "reference/camera_rays.h"
#include "reference/ray_scene.h"

namespace raybundle {

/// With which probability a walk survives a reflection.
enum class Survival {
    throughput,  ///< largest channel of the whole walk's throughput
    albedo,      ///< the local albedo for the walk's direction, largest channel (ch. 3.2)
    fixed        ///< the same everywhere
};

/// What chapter 3 asks of a scene: the mean albedo a, and E[alpha^2] and D^2[alpha] of the estimate
/// alpha = Le w/p of the light that is reflected once.
struct WalkStatistics {
    double albedo = 0.0;       ///< 0..1
    double mean_square = 0.0;  ///< E[alpha^2], cd²/m⁴
    double variance = 0.0;     ///< D^2[alpha], within pixels
};

/// Variance of a walk of up to `bounces` reflections times the number of its rays, eq. 3.16, for a
/// survival probability in (0, 1]. It treats the reflections as independent.
double walk_variance(const WalkStatistics& statistics, double survival, int bounces);

/// The survival probability between the albedo and 1 at which walk_variance() is smallest. The
/// flatter the light (the smaller D^2), the closer to 1.
double optimal_survival(const WalkStatistics& statistics, int bounces);

/// Statistics of what a picture shows, by so many samples (at least 2) of every pixel's first
/// reflection; luminances. Pixels that show no reflecting surface do not count.
WalkStatistics measure_walks(const RayScene& scene, const CameraRays& camera, std::uint32_t samples,
                             std::uint64_t seed);

}  // namespace raybundle
