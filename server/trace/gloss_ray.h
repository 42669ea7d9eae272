// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace raybundle {

/// A ray from a glossy surface, drawn from its lobe; as shaders/view/specular/gloss_ray.glsl has
/// it.
struct GlossRay {
    glm::vec3 origin{0.0F};  ///< m; where nothing is met the radiance of the sky, radiance units
    std::uint32_t facet = unused;  ///< that it begins on, which hides nothing
    glm::vec3 direction{0.0F};     ///< unit
    std::uint32_t surface = 0;     ///< that it meets, 2 * facet + side, or FacetTracer::no_hit
    static constexpr std::uint32_t unused = 0xffffffffU;
};
static_assert(sizeof(GlossRay) == 32);

}  // namespace raybundle
