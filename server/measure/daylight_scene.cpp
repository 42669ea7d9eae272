// SPDX-License-Identifier: Apache-2.0
#include "measure/daylight_scene.h"

#include <algorithm>

#include "scene/light/sky_dome.h"

namespace raybundle {

void leave_overcast_sky(Scene& scene, PatchMesh& mesh) {
    SkyDomeSettings settings;
    if (const auto* const own = dynamic_cast<const SkyDome*>(scene.environment.get())) {
        settings.ground_albedo = own->settings().ground_albedo;
        settings.sky.type = own->settings().sky.type == 1 ? 1 : CieSky::traditional_overcast;
    }
    settings.zenith_luminance =
        overcast_illuminance / settings.sky.relative_illuminance({0.0, 1.0, 0.0});
    scene.punctual_lights.clear();
    scene.sky_radiance = glm::vec3(0.0F);
    for (Material& material : scene.materials) {
        material.emission = glm::vec3(0.0F);
    }
    std::fill(mesh.emission.begin(), mesh.emission.end(), glm::vec3(0.0F));
    set_environment(std::make_shared<SkyDome>(settings), scene);
}

}  // namespace raybundle
