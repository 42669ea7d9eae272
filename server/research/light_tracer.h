// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "reference/camera_rays.h"
#include "reference/measures/image_estimate.h"
#include "reference/ray_scene.h"
#include "reference/sampling/light_sampling.h"
#include "reference/sampling/random.h"

namespace raybundle {

/// Light tracing (Arvo 1986; Dutré, Lafortune, Willems 1993): particles walk from the lights by the
/// BRDF and by mirrors and glass, and each surface they reach that the eye sees brightens the pixel
/// where it is seen. What the eye sees of emitters and the sky is found by rays from the eye, by
/// way of mirrors and glass too; other surfaces behind those are not found.
class LightTracer {
  public:
    LightTracer(const RayScene& scene, const LightSampling& lights, const CameraRays& camera)
        : scene_(scene), lights_(lights), camera_(camera) {}

    /// Emission along a unit direction from the eye, cd/m², and one particle, whose light goes to
    /// `splats`.
    [[nodiscard]] glm::dvec3 radiance(const glm::dvec3& direction, PixelSampler& sampler,
                                      std::vector<Splat>& splats) const;

  private:
    void follow_particle(PixelSampler& sampler, std::vector<Splat>& splats) const;
    void show(const SurfacePoint& point, const glm::dvec3& from, const glm::dvec3& power,
              std::vector<Splat>& splats) const;

    const RayScene& scene_;
    const LightSampling& lights_;
    CameraRays camera_;
};

}  // namespace raybundle
