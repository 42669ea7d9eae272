// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "scene/light/punctual_light.h"

namespace raybundle {

/// Where a light without extent is in the world, and how it is turned.
struct LightPlace {
    glm::vec3 position{0.0F};          ///< m
    glm::vec3 aim{0.0F, -1.0F, 0.0F};  ///< unit: the direction it shines in, photometric angle 0
    /// About the aim, right-handed, degrees. At 0 the photometric plane C0 lies along +x while the
    /// light is aimed down; it turns on the shortest way from there to the aim.
    float rotation = 0.0F;
};

/// Of a light that no object carries.
LightPlace place_of(const PunctualLight& light);

/// Puts a light that no object carries there. A mirrored luminaire stays mirrored.
void set_place(const LightPlace& place, PunctualLight& light);

}  // namespace raybundle
