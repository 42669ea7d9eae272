// SPDX-License-Identifier: Apache-2.0
#include "scene/walk/camera_axes.h"

#include <cmath>

namespace raybundle {

CameraAxes camera_axes(const Camera& camera, glm::uvec2 size) {
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    glm::vec3 right = glm::cross(forward, camera.up);
    if (glm::dot(right, right) < 1e-12F) {  // looking along `up`: any other axis will do
        right = glm::cross(forward,
                           std::abs(forward.x) < 0.9F ? glm::vec3(1, 0, 0) : glm::vec3(0, 0, 1));
    }
    right = glm::normalize(right);
    const float half_height = std::tan(0.5F * camera.vertical_fov);
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    return {right * (half_height * aspect), glm::cross(right, forward) * half_height, forward};
}

}  // namespace raybundle
