// SPDX-License-Identifier: Apache-2.0
#include "scene/light/light_figures.h"

#include <algorithm>
#include <glm/gtc/constants.hpp>

namespace raybundle {

LightFigures loaded_figures(const Light& light) {
    LightFigures figures;
    figures.flux = glm::pi<double>() * static_cast<double>(luminance(light.loaded)) * light.area;
    return figures;
}

LightFigures loaded_figures(const PunctualLight& light) {
    LightFigures figures;
    if (light.kind == PunctualKind::directional) {
        return figures;
    }
    PunctualLight loaded = light;
    loaded.intensity = setting_of(light).loaded;
    figures.flux =
        static_cast<double>(luminance(glm::vec3(place_light(loaded, glm::mat4(1.0F)).flux())));
    figures.peak = static_cast<double>(luminance(loaded.intensity));
    if (light.profile) {
        const IesProfile::Data& data = light.profile->data();
        figures.peak *= *std::max_element(data.candela.begin(), data.candela.end());
        figures.watts = data.input_watts;
    }
    return figures;
}

}  // namespace raybundle
