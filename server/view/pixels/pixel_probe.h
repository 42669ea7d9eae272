// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "gpu/layouts.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {

/// What a pixel of a viewer shows.
struct PixelProbe {
    glm::vec3 position{0.0F};  ///< world, m
    glm::vec3 normal{0.0F};    ///< world, unit, shading
    std::uint32_t object = 0;  ///< index into Scene::objects
    std::uint32_t patch = 0;
    glm::vec3 irradiance{0.0F};            ///< lx
    glm::vec3 radiance{0.0F};              ///< towards the eye, cd/m²
    std::optional<double> relative_error;  ///< standard error, where estimated
};

/// Of what view_probe.comp has found.
PixelProbe from_pick(const layout::PickResult& pick, const GpuScene& scene);

}  // namespace raybundle
