// SPDX-License-Identifier: Apache-2.0
#include "view/camera_matrices.h"

#include "scene/camera_axes.h"

namespace raybundle {

layout::ViewParameters make_view_parameters(const Camera& camera, const glm::vec3& scene_origin,
                                            glm::uvec2 size, float near_distance) {
    const CameraAxes axes = camera_axes(camera, size);
    const glm::vec3 eye = camera.eye - scene_origin;
    const auto row = [&eye](const glm::vec3& v) { return glm::vec4(v, -glm::dot(v, eye)); };
    layout::ViewParameters p{};
    p.clip_from_world =
        glm::transpose(glm::mat4(row(axes.right / glm::dot(axes.right, axes.right)),
                                 row(axes.up / glm::dot(axes.up, axes.up)),
                                 glm::vec4(0, 0, 0, near_distance), row(axes.forward)));
    p.eye = glm::vec4(eye, 1.0F);
    p.right = glm::vec4(axes.right, 0.0F);
    p.up = glm::vec4(axes.up, 0.0F);
    p.forward = glm::vec4(axes.forward, 0.0F);
    p.size = picture_size(size);
    return p;
}

glm::uvec4 picture_size(glm::uvec2 pixels) {
    return {pixels, (pixels + 3U) / 4U};
}

glm::vec3 pixel_direction(const Camera& camera, glm::uvec2 size, glm::vec2 pixel) {
    const CameraAxes axes = camera_axes(camera, size);
    const glm::vec2 ndc = (pixel + 0.5F) / glm::vec2(size) * 2.0F - 1.0F;
    return glm::normalize(axes.forward + ndc.x * axes.right - ndc.y * axes.up);
}

}  // namespace raybundle
