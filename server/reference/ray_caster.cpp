// SPDX-License-Identifier: Apache-2.0
#include "reference/ray_caster.h"

#include "reference/scattering.h"

namespace raybundle {

glm::dvec3 RayCaster::radiance(const glm::dvec3& origin, const glm::dvec3& direction,
                               PixelSampler& sampler) const {
    const std::optional<SurfacePoint> hit = scene_.trace(origin, direction);
    if (!hit) {
        return glm::dvec3(scene_.scene().sky_radiance);
    }
    if (hit->absorbs() || lights_.empty()) {
        return scene_.emission(*hit);
    }
    const Scattering scattering(scene_, *hit, NormalKind::shading, -direction);
    const double choice = sampler.next();
    const std::optional<LightSample> light =
        lights_.sample(*hit, scattering.frame(), choice, sampler.next_pair());
    glm::dvec3 reflected(0.0);
    if (light) {
        reflected = scattering.evaluate(light->direction) * light->radiance / light->density;
    }
    const bool lit = reflected != glm::dvec3(0.0) && lights_.arrives(*hit, *light);
    return scene_.emission(*hit) + (lit ? reflected : glm::dvec3(0.0));
}

}  // namespace raybundle
