// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "measure/point_paths.h"

namespace raybundle {

/// Light in one direction.
struct SampledLight {
    glm::dvec3 direction{0.0};  ///< unit, to where it comes from
    double luminance = 0.0;     ///< cd/m²
};

/// An estimate of all light that arrives at a point (own space) from a direction, but what comes
/// straight from emitting surfaces, or from them through panes; by mirrors it counts. Suns are left
/// out.
double background_luminance(const MeasuredScene& scene, const glm::dvec3& position,
                            const glm::dvec3& direction, Sampler& sampler);

/// A direction to a point of each sun's disc, and the illuminance of what faces it, lx, through
/// panes: 0 where it is hidden.
void for_each_sun(const MeasuredScene& scene, const glm::dvec3& position, Sampler& sampler,
                  const std::function<void(const PlacedLight&, const SampledLight&)>& take);

}  // namespace raybundle
