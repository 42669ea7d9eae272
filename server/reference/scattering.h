// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "reference/ray_scene.h"
#include "reference/sampling/directions.h"
#include "scene/material/brdf.h"

namespace raybundle {

/// A direction drawn about in proportion to what a surface scatters there.
struct ScatterSample {
    glm::dvec3 direction{0.0};  ///< unit
    glm::dvec3 weight{0.0};     ///< f_r cos / density
    double density = 0.0;       ///< per solid angle, 1/sr
};

enum class NormalKind { geometric, shading };

/// Reflection at a surface point to one outgoing direction, by the BRDF of scene/material/brdf.h.
/// Directions are unit, point away from the surface and lie in the space of the ray scene. BRDFs
/// are reciprocal, so light that comes in from `outgoing` is scattered by the same formulas.
class Scattering {
  public:
    /// normal: shading where the picture shows the point, geometric for light between surfaces, as
    /// the patches know no other. An outgoing direction below the horizon of the shading normal
    /// counts as one just above it, so that silhouettes are not black.
    Scattering(const RayScene& scene, const SurfacePoint& point, NormalKind normal,
               const glm::dvec3& outgoing);

    /// A Lambert surface of albedo 1 about the geometric normal: pi times what it reflects is the
    /// irradiance.
    static Scattering white(const SurfacePoint& point);
    /// A Lambert surface of this albedo about the geometric normal.
    static Scattering lambert(const SurfacePoint& point, const glm::vec3& albedo);

    /// f_r cos_in, 1/sr; 0 for directions behind the surface. cos_in is the shading normal's.
    [[nodiscard]] glm::dvec3 evaluate(const glm::dvec3& incoming) const;
    /// f_r alone, 1/sr.
    [[nodiscard]] glm::dvec3 reflectance(const glm::dvec3& incoming) const;
    /// Density with which sample() draws a direction, 1/sr.
    [[nodiscard]] double density(const glm::dvec3& incoming) const;
    /// Density with which the outgoing direction would be drawn for light to or from `incoming`,
    /// 1/sr. Geometric normals only.
    [[nodiscard]] double reverse_density(const glm::dvec3& incoming) const;
    /// Nothing where the direction drawn lies behind the surface. u and choice: independent uniform
    /// numbers in (0, 1).
    [[nodiscard]] std::optional<ScatterSample> sample(const glm::dvec2& u, double choice) const;

    [[nodiscard]] const Frame& frame() const { return frame_; }
    [[nodiscard]] const Brdf& brdf() const { return brdf_; }
    /// Cosine of the outgoing direction.
    [[nodiscard]] float outgoing_cosine() const { return outgoing_.z; }
    [[nodiscard]] bool is_lambert() const { return brdf_.lobe.kind == LobeKind::none; }

  private:
    Scattering(const SurfacePoint& point, const glm::dvec3& normal, const glm::dvec3& outgoing,
               const Brdf& brdf);

    [[nodiscard]] bool in_front(const glm::dvec3& incoming) const {
        return glm::dot(incoming, frame_.z) > 0.0 && glm::dot(incoming, geometric_normal_) > 0.0;
    }

    glm::dvec3 geometric_normal_;
    Frame frame_;         // about the shading normal
    glm::vec3 outgoing_;  // in that frame
    Brdf brdf_;
};

}  // namespace raybundle
