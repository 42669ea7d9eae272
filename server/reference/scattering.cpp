// SPDX-License-Identifier: Apache-2.0
#include "reference/scattering.h"

namespace raybundle {
namespace {

/// Outgoing directions are at least this far above the horizon.
constexpr double min_outgoing_cosine = 1e-4;

glm::vec3 above_horizon(glm::dvec3 local) {
    if (local.z >= min_outgoing_cosine) {
        return glm::vec3(local);
    }
    local.z = min_outgoing_cosine;
    return glm::vec3(glm::normalize(local));
}

}  // namespace

Scattering::Scattering(const SurfacePoint& point, const glm::dvec3& normal,
                       const glm::dvec3& outgoing, const Brdf& brdf)
    : geometric_normal_(point.normal),
      frame_(normal),
      outgoing_(above_horizon(frame_.to_local(outgoing))),
      brdf_(brdf) {}

Scattering::Scattering(const RayScene& scene, const SurfacePoint& point, NormalKind normal,
                       const glm::dvec3& outgoing)
    : Scattering(
          point,
          normal == NormalKind::shading ? scene.shading_normal(point, outgoing) : point.normal,
          outgoing, scene.brdf(point)) {}

Scattering Scattering::white(const SurfacePoint& point) {
    return lambert(point, glm::vec3(1.0F));
}

Scattering Scattering::lambert(const SurfacePoint& point, const glm::vec3& albedo) {
    Brdf brdf;
    brdf.lambert = albedo;
    return {point, point.normal, point.normal, brdf};
}

glm::dvec3 Scattering::evaluate(const glm::dvec3& incoming) const {
    if (!in_front(incoming)) {
        return glm::dvec3(0.0);
    }
    return reflectance(incoming) * glm::dot(incoming, frame_.z);
}

glm::dvec3 Scattering::reflectance(const glm::dvec3& incoming) const {
    return glm::dvec3(raybundle::evaluate(brdf_, glm::vec3(frame_.to_local(incoming)), outgoing_));
}

double Scattering::density(const glm::dvec3& incoming) const {
    if (!in_front(incoming)) {
        return 0.0;
    }
    return pdf(brdf_, glm::vec3(frame_.to_local(incoming)), outgoing_);
}

double Scattering::reverse_density(const glm::dvec3& incoming) const {
    if (!in_front(incoming)) {
        return 0.0;
    }
    return pdf(brdf_, outgoing_, glm::vec3(frame_.to_local(incoming)));
}

std::optional<ScatterSample> Scattering::sample(const glm::dvec2& u, double choice) const {
    const BrdfSample drawn =
        raybundle::sample(brdf_, outgoing_, glm::vec2(u), static_cast<float>(choice));
    if (!(drawn.w_in.z > 0.0F && drawn.pdf > 0.0F)) {
        return std::nullopt;
    }
    const glm::dvec3 direction = glm::normalize(frame_.to_world(glm::dvec3(drawn.w_in)));
    if (!in_front(direction)) {
        return std::nullopt;
    }
    const double density = drawn.pdf;
    return ScatterSample{direction, evaluate(direction) / density, density};
}

}  // namespace raybundle
