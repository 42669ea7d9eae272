// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "reference/random.h"
#include "reference/ray_scene.h"

namespace raybundle {

/// What a ray meets behind all the mirrors and glass on its way.
struct SpecularWalk {
    std::optional<SurfacePoint> hit;  ///< neither of them; nothing: the sky
    glm::dvec3 direction{0.0};        ///< unit, in which it arrives there
    glm::dvec3 weight{1.0};           ///< of the light that comes this way
    bool passed = false;              ///< there was one
};

/// Goes on from what a ray of this direction has met as long as that is glass (scene/
/// specular_surface.h), where one of reflection and refraction is chosen by what they carry, or an
/// ideal mirror. Of at most most_surfaces; then the light is lost. Draws no number where there is
/// no glass.
///
/// A metal smoother than min_roughness is an ideal mirror, unless punctual lights shine: their
/// light is found by way of a lobe alone, which then has min_roughness.
SpecularWalk walk_specular(const RayScene& scene, const std::optional<SurfacePoint>& hit,
                           const glm::dvec3& direction, Sampler& sampler);

}  // namespace raybundle
