// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "reference/ray_scene.h"
#include "scene/camera_axes.h"

namespace raybundle {

/// Rays of a picture, in the own space of a ray scene.
class CameraRays {
  public:
    CameraRays(const RayScene& scene, const Camera& camera, glm::uvec2 size)
        : origin_(scene.from_world(camera.eye)), size_(size) {
        const CameraAxes axes = camera_axes(camera, size);
        right_ = axes.right;
        up_ = axes.up;
        forward_ = axes.forward;
    }

    [[nodiscard]] const glm::dvec3& origin() const { return origin_; }
    [[nodiscard]] const glm::uvec2& size() const { return size_; }
    /// Unit direction through a point of the picture in pixels from its top left corner; pixel
    /// (i, j) covers [i, i+1) x [j, j+1).
    [[nodiscard]] glm::dvec3 direction(const glm::dvec2& at) const {
        const glm::dvec2 edge = at / glm::dvec2(size_) * 2.0 - 1.0;
        return glm::normalize(forward_ + edge.x * right_ - edge.y * up_);
    }

  private:
    glm::dvec3 origin_;
    glm::uvec2 size_;
    glm::dvec3 right_{0.0}, up_{0.0}, forward_{0.0};
};

}  // namespace raybundle
