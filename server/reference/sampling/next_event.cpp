// SPDX-License-Identifier: Apache-2.0
#include "reference/sampling/next_event.h"

#include <optional>

namespace raybundle {

glm::dvec3 next_event(const LightSampling& lights, const SurfacePoint& point,
                      const Scattering& scattering, double lobe_samples, Sampler& sampler,
                      Panes panes) {
    if (lights.empty()) {
        return glm::dvec3(0.0);
    }
    const double choice = sampler.next();
    const std::optional<LightSample> light =
        lights.sample(point, scattering.frame(), choice, sampler.next_pair());
    if (!light) {
        return glm::dvec3(0.0);
    }
    const glm::dvec3 value = scattering.evaluate(light->direction) * light->radiance;
    if (value == glm::dvec3(0.0)) {
        return glm::dvec3(0.0);
    }
    const glm::dvec3 share = panes == Panes::pass
                                 ? lights.arriving_share(point, *light)
                                 : glm::dvec3(lights.arrives(point, *light) ? 1.0 : 0.0);
    const double other =
        lobe_samples > 0.0 ? lobe_samples * scattering.density(light->direction) : 0.0;
    return share * value * (light->weight(other) / light->density);
}

}  // namespace raybundle
