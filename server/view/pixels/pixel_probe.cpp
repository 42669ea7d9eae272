// SPDX-License-Identifier: Apache-2.0
#include "view/pixels/pixel_probe.h"

#include <bit>

namespace raybundle {

PixelProbe from_pick(const layout::PickResult& pick, const GpuScene& scene) {
    PixelProbe result;
    result.position = glm::vec3(pick.position) + scene.origin();
    result.normal = glm::vec3(pick.normal);
    result.object = std::bit_cast<std::uint32_t>(pick.normal.w);
    result.patch = std::bit_cast<std::uint32_t>(pick.irradiance.w);
    result.irradiance = glm::vec3(pick.irradiance) * scene.radiance_unit();
    result.radiance = glm::vec3(pick.radiance) * scene.radiance_unit();
    if (pick.radiance.w >= 0.0F) {
        result.relative_error = static_cast<double>(pick.radiance.w);
    }
    return result;
}

}  // namespace raybundle
