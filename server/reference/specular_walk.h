// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "reference/ray_scene.h"
#include "reference/sampling/random.h"

namespace raybundle {

/// What is carried along a ray: radiance, against the way of the light, by paths from the eye; or
/// power, with the light. At smooth normals they differ (Veach 1997, ch. 5.3). Inside of glass both
/// are without the squared index of refraction, which cancels for whatever begins and ends in air.
enum class Carried { radiance, power };

/// One deflection at a mirror or at glass.
struct Deflection {
    SurfacePoint departure;          ///< the point, its normal on the side where the ray goes on
    glm::dvec3 direction{0.0};       ///< unit, in which it goes on
    glm::dvec3 weight{1.0};          ///< of what is carried, over `chance`
    double chance = 1.0;             ///< of this way; the same for a ray that comes back
    double index = 1.0;              ///< of refraction, after over before
    double solid_angle_ratio = 1.0;  ///< of a narrow cone of rays, after over before
};

/// Deflects a ray of this direction at a point that is an ideal mirror or glass (scene/
/// specular_surface.h), where one of reflection and refraction is chosen by what they carry.
/// Nothing where the surface is neither; then no number is drawn.
///
/// A metal smoother than min_roughness is an ideal mirror, unless punctual lights shine: path
/// tracing finds their light by way of a lobe alone, which then has min_roughness.
std::optional<Deflection> deflect(const RayScene& scene, const SurfacePoint& point,
                                  const glm::dvec3& direction, Carried carried, Sampler& sampler);

/// Whether rays are deflected at a point.
bool is_deflecting(const RayScene& scene, const SurfacePoint& point);

/// Share that is left of what is carried from a point that has deflected it to the next one. One
/// that ends at the back of a surface of glass was inside of it.
glm::dvec3 left_of_way(const RayScene& scene, const glm::dvec3& from, const SurfacePoint& to);

/// Whether a ray that ends at a point was inside of a body of glass.
bool ends_inside_glass(const RayScene& scene, const SurfacePoint& to);

/// What a ray meets behind all the mirrors and glass on its way.
struct SpecularWalk {
    std::optional<SurfacePoint> hit;  ///< neither of them; nothing: the sky
    glm::dvec3 direction{0.0};        ///< unit, in which it arrives there
    glm::dvec3 weight{1.0};           ///< of what is carried this way
    bool passed = false;              ///< there was one
    /// Luminance, cd/m², of the body of a luminaire that an eye's ray meets first; there is no hit
    /// then.
    std::optional<glm::dvec3> luminaire{};
};

/// Goes on from what a ray of this direction has met as long as that deflects it. At most
/// most_surfaces times; then the light is lost.
SpecularWalk walk_specular(const RayScene& scene, const std::optional<SurfacePoint>& hit,
                           const glm::dvec3& direction, Carried carried, Sampler& sampler);

/// The same of a ray from an eye, which sees luminaires.
SpecularWalk walk_from_eye(const RayScene& scene, const glm::dvec3& origin,
                           const glm::dvec3& direction, Sampler& sampler);

/// The same by the stronger way at each surface of glass, without chance: what a viewer takes a
/// pixel to show. Mirrors are all those of scene/material/specular_surface.h, ideal or not.
SpecularWalk walk_strongest(const RayScene& scene, const glm::dvec3& origin,
                            const glm::dvec3& direction);

}  // namespace raybundle
