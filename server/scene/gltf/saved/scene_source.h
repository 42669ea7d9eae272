// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "scene/gltf/file/gltf_container.h"
#include "scene/gltf/gltf_lights.h"
#include "scene/light/daylight.h"
#include "scene/scene.h"

namespace raybundle {

/// How a scene was read, and what it was like then: what has been changed since is what differs.
struct SceneSource {
    FileMark file;
    float metres_per_unit = 1.0F;
    std::vector<std::string> ies;  ///< as SceneSettings::ies
    Daylight daylight;             ///< of file and settings together
    float sky_luminance = 0.0F;    ///< of a uniform sky, cd/m²; 0: none
    std::vector<Material> materials;
    std::vector<Transform> transforms;  ///< of Scene::objects
    /// Of each object: whether something else hangs below its node, or a skin, so that moving the
    /// node is not moving the object.
    std::vector<bool> entangled;
    std::vector<PunctualLight> lights;       ///< without suns
    std::vector<LightSource> light_sources;  ///< of these
};

}  // namespace raybundle
