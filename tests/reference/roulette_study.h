// SPDX-License-Identifier: Apache-2.0
// The measurements of chapter 3.4: variance of gathering walks against their survival probability.
#pragma once

#include <vector>

#include "reference/sampling/russian_roulette.h"
#include "rooms.h"

namespace raybundle {

/// A closed scene, so that walks end by Russian roulette alone, and what looks at it.
struct WalkScene {
    SceneBuilder builder;
    Camera camera;
};

/// A sphere of albedo 0.314 that emits the same everywhere (ch. 3.4.1, figures 3.5 and 3.6).
WalkScene constant_scene();
/// A sphere round a lamp and three balls that emit little, all of one albedo (ch. 3.4.2, fig. 3.7).
WalkScene lamp_scene(float albedo);
/// A furnished room of several colours (ch. 3.4.3, figure 3.8).
WalkScene room_scene();

/// Variance of a pixel after a given number of rays per pixel, mean over the picture, and its
/// standard error; luminance squared, cd²/m⁴.
struct WalkVariance {
    double survival = 0.0;
    double variance = 0.0;
    double standard_error = 0.0;
};

/// Steps of a walk after the first are survived with a fixed probability, so that it has
/// 1/(1 - survival) rays besides the eye's. `walks` for every pixel, at its centre.
WalkVariance measure_variance(const WalkScene& walk_scene, double survival, std::uint32_t walks,
                              double rays_per_pixel);

constexpr glm::uvec2 study_size(16, 16);
/// As in the dissertation: 1.5 million rays for 181 x 181 pixels.
constexpr double study_rays_per_pixel = 1'500'000.0 / (181.0 * 181.0);

}  // namespace raybundle
