// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "reference/random.h"
#include "reference/ray_scene.h"

namespace raybundle {

/// What a ray meets behind all the glass on its way.
struct GlassWalk {
    std::optional<SurfacePoint> hit;  ///< no glass; nothing: the sky
    glm::dvec3 direction{0.0};        ///< unit, in which it arrives there
    glm::dvec3 weight{1.0};           ///< of the light that comes this way
    bool passed = false;              ///< there was glass
};

/// Goes on from what a ray of this direction has met as long as that is glass (scene/
/// specular_surface.h): at every surface one of reflection and refraction is chosen by what they
/// carry. Of at most most_surfaces; then the light is lost. Draws no number where there is no
/// glass.
GlassWalk walk_through_glass(const RayScene& scene, const std::optional<SurfacePoint>& hit,
                             const glm::dvec3& direction, Sampler& sampler);

}  // namespace raybundle
