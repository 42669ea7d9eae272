// SPDX-License-Identifier: Apache-2.0
#include "reference/scattering.h"

namespace raybundle {

Scattering::Scattering(const RayScene& scene, const SurfacePoint& point, NormalKind normal,
                       const glm::dvec3& /*outgoing*/)
    : Scattering(point, normal == NormalKind::shading ? scene.shading_normal(point) : point.normal,
                 scene.albedo(point)) {}

Scattering Scattering::white(const SurfacePoint& point) {
    return {point, point.normal, glm::dvec3(1.0)};
}

glm::dvec3 Scattering::evaluate(const glm::dvec3& incoming) const {
    return albedo_ * density(incoming);
}

double Scattering::density(const glm::dvec3& incoming) const {
    const double cosine = glm::dot(incoming, frame_.z);
    const bool in_front = cosine > 0.0 && glm::dot(incoming, geometric_normal_) > 0.0;
    return in_front ? cosine * glm::one_over_pi<double>() : 0.0;
}

std::optional<ScatterSample> Scattering::sample(const glm::dvec2& u) const {
    const glm::dvec3 local = cosine_hemisphere(u);
    const glm::dvec3 direction = frame_.to_world(local);
    if (!(local.z > 0.0) || !(glm::dot(direction, geometric_normal_) > 0.0)) {
        return std::nullopt;
    }
    return ScatterSample{direction, albedo_, local.z * glm::one_over_pi<double>()};
}

}  // namespace raybundle
