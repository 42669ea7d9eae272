// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "reference/directions.h"
#include "reference/ray_scene.h"

namespace raybundle {

/// A direction drawn in proportion to what a surface scatters there.
struct ScatterSample {
    glm::dvec3 direction{0.0};  ///< unit
    glm::dvec3 weight{0.0};     ///< f_r cos / density
    double density = 0.0;       ///< per solid angle, 1/sr
};

enum class NormalKind { geometric, shading };

/// Reflection at a surface point. Directions are unit, point away from the surface and lie in the
/// space of the ray scene.
class Scattering {
  public:
    /// normal: shading where the picture shows the point, geometric for light between surfaces, as
    /// the patches know no other.
    Scattering(const RayScene& scene, const SurfacePoint& point, NormalKind normal,
               const glm::dvec3& outgoing);

    /// A Lambert surface of albedo 1 about the geometric normal: pi times what it reflects is the
    /// irradiance.
    static Scattering white(const SurfacePoint& point);

    /// f_r cos_in, 1/sr; 0 for directions behind the surface. cos_in is the shading normal's.
    [[nodiscard]] glm::dvec3 evaluate(const glm::dvec3& incoming) const;
    /// Density with which sample() draws a direction, 1/sr.
    [[nodiscard]] double density(const glm::dvec3& incoming) const;
    /// Nothing where the direction drawn lies behind the surface.
    [[nodiscard]] std::optional<ScatterSample> sample(const glm::dvec2& u) const;

    [[nodiscard]] const Frame& frame() const { return frame_; }

  private:
    Scattering(const SurfacePoint& point, const glm::dvec3& normal, const glm::dvec3& albedo)
        : geometric_normal_(point.normal), frame_(normal), albedo_(albedo) {}

    glm::dvec3 geometric_normal_;
    Frame frame_;  // about the shading normal
    glm::dvec3 albedo_;
};

}  // namespace raybundle
