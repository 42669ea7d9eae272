// SPDX-License-Identifier: Apache-2.0
#include "scene/contact/world_triangle.h"

namespace raybundle {

std::array<glm::dvec3, 3> world_corners(const Scene& scene, const Triangle& triangle) {
    const glm::mat4 world = scene.objects[triangle.object].world_from_object();
    std::array<glm::dvec3, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
        corners[k] =
            glm::dvec3(world * glm::vec4(scene.vertices[triangle.vertex[k]].position, 1.0F));
    }
    return corners;
}

}  // namespace raybundle
