// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "reference/ray_scene.h"
#include "reference/sampling/light_sampling.h"
#include "reference/sampling/random.h"
#include "reference/scattering.h"

namespace raybundle {

/// Local rendering (appendix A, "DirectLight"): emitted light and its first reflection, light path
/// classes LE, LDE and LGE, seen in ideal mirrors and through glass too; neither throws light.
/// Lambert surfaces sample points of the emitters and directions of the sky; glossy ones their lobe
/// as well, both weighted by the power heuristic.
class RayCaster {
  public:
    RayCaster(const RayScene& scene, const LightSampling& lights)
        : scene_(scene), lights_(lights) {}

    /// Unbiased estimate of the emitted and once reflected radiance that arrives at a point in
    /// space (own space of the ray scene) against a unit direction, cd/m².
    [[nodiscard]] glm::dvec3 radiance(const glm::dvec3& origin, const glm::dvec3& direction,
                                      PixelSampler& sampler) const;

  private:
    [[nodiscard]] glm::dvec3 met(const SurfacePoint& point, const Scattering& scattering,
                                 PixelSampler& sampler) const;

    const RayScene& scene_;
    const LightSampling& lights_;
};

}  // namespace raybundle
