// SPDX-License-Identifier: Apache-2.0
#include "measure/daylight_scene.h"

#include <algorithm>
#include <vector>

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

void maintain_lamps(Scene& scene, PatchMesh& mesh) {
    std::vector<float> left(scene.materials.size(), 1.0F);
    for (const Light& light : scene.lights) {
        if (light.material >= 0) {
            left[static_cast<std::size_t>(light.material)] = light.control.maintenance_factor;
        }
    }
    for (std::size_t i = 0; i < left.size(); ++i) {
        scene.materials[i].emission *= left[i];
    }
    for (std::size_t side = 0; side < mesh.side_count(); ++side) {
        mesh.emission[side] *= left[mesh.triangle_material[mesh.side_triangle[side]]];
    }
    for (PunctualLight& light : scene.punctual_lights) {
        light.intensity *= light.of_sky ? 1.0F : light.control.maintenance_factor;
    }
}

}  // namespace raybundle
