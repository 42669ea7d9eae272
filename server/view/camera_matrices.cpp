// SPDX-License-Identifier: Apache-2.0
#include "view/camera_matrices.h"

#include "scene/walk/camera_axes.h"

namespace raybundle {

layout::ViewParameters make_view_parameters(const Camera& camera, const glm::vec3& scene_origin,
                                            glm::uvec2 size, float near_distance) {
    const glm::vec2 centre(camera.part);
    const glm::vec2 extent(camera.part.z, camera.part.w);
    const CameraAxes axes = camera_axes(camera, glm::uvec2(glm::round(glm::vec2(size) / extent)));
    const glm::vec3 eye = camera.eye - scene_origin;
    const auto row = [&eye](const glm::vec3& v) { return glm::vec4(v, -glm::dot(v, eye)); };
    const auto across = [&](const glm::vec3& axis, float from_centre, float share) {
        return row((axis / glm::dot(axis, axis) - from_centre * axes.forward) / share);
    };
    layout::ViewParameters p{};
    p.clip_from_world = glm::transpose(
        glm::mat4(across(axes.right, centre.x, extent.x), across(axes.up, centre.y, extent.y),
                  glm::vec4(0, 0, 0, near_distance), row(axes.forward)));
    p.eye = glm::vec4(eye, 1.0F);
    p.right = glm::vec4(extent.x * axes.right, 0.0F);
    p.up = glm::vec4(extent.y * axes.up, 0.0F);
    p.forward = glm::vec4(axes.forward + centre.x * axes.right + centre.y * axes.up, 0.0F);
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
