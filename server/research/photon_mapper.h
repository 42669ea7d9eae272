// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "reference/ray_scene.h"
#include "reference/sampling/light_sampling.h"
#include "reference/sampling/random.h"
#include "reference/specular_walk.h"
#include "research/photon_tracer.h"

namespace raybundle {

/// Photon mapping (Jensen 2001, ch. 9). Where the eye, or a ray from an S surface, meets a D
/// surface: direct light as in path tracing, LS+D by the caustic map, and the rest by final
/// gathering, rays whose ends look into the global map. Rays shorter than the estimate's radius end
/// in another gathering, since the map is blurred there (ch. 9.2). S surfaces, mirrors and glass
/// among them, are path-traced.
///
/// Light of punctual lights that comes to S surfaces by way of glass is found by neither.
///
/// Biased: density estimation blurs, and loses light at edges. The bias falls with the number of
/// photons per map, the variance with the number of maps too.
class PhotonMapper {
  public:
    PhotonMapper(const RayScene& scene, const LightSampling& lights, const PhotonSettings& settings)
        : scene_(scene),
          lights_(lights),
          settings_(settings),
          radius_(settings.radius * scene.diameter()) {}

    /// Estimate of the radiance that arrives at a point in space against a unit direction, cd/m².
    [[nodiscard]] glm::dvec3 radiance(const PhotonMaps& maps, const glm::dvec3& origin,
                                      const glm::dvec3& direction, PixelSampler& sampler) const;

  private:
    [[nodiscard]] glm::dvec3 met_light(const SurfacePoint& point, const Scattering& scattering,
                                       const ScatterSample& drawn, const SpecularWalk& met) const;
    [[nodiscard]] SpecularWalk met_by(const SurfacePoint& point, const ScatterSample& drawn,
                                      PixelSampler& sampler) const;
    [[nodiscard]] glm::dvec3 by_sharp(const PhotonMaps& maps, SurfacePoint point,
                                      Scattering scattering, PixelSampler& sampler) const;
    [[nodiscard]] glm::dvec3 by_maps(const PhotonMaps& maps, const SurfacePoint& point,
                                     const Scattering& scattering, int gatherings,
                                     PixelSampler& sampler) const;
    [[nodiscard]] glm::dvec3 gathered(const PhotonMaps& maps, SurfacePoint point,
                                      Scattering scattering, int gatherings,
                                      PixelSampler& sampler) const;

    const RayScene& scene_;
    const LightSampling& lights_;
    PhotonSettings settings_;
    double radius_;  // own space
};

}  // namespace raybundle
