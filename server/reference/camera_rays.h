// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>

#include "reference/ray_scene.h"
#include "scene/walk/camera_axes.h"

namespace raybundle {

/// Where a picture shows what lies in a direction.
struct FilmPoint {
    std::size_t pixel = 0;    ///< row by row from the top
    double importance = 0.0;  ///< pixels per solid angle there, 1/sr
};

/// Rays of a picture, in the own space of a ray scene.
class CameraRays {
  public:
    CameraRays(const RayScene& scene, const Camera& camera, glm::uvec2 size)
        : origin_(scene.from_world(camera.eye)), size_(size) {
        const CameraAxes axes = camera_axes(camera, size);
        right_ = axes.right;
        up_ = axes.up;
        forward_ = axes.forward;
        pixels_per_area_ =
            static_cast<double>(size.x) * size.y / (4.0 * glm::length(right_) * glm::length(up_));
    }

    [[nodiscard]] const glm::dvec3& origin() const { return origin_; }
    [[nodiscard]] const glm::uvec2& size() const { return size_; }
    /// Unit direction through a point of the picture in pixels from its top left corner; pixel
    /// (i, j) covers [i, i+1) x [j, j+1).
    [[nodiscard]] glm::dvec3 direction(const glm::dvec2& at) const {
        const glm::dvec2 edge = at / glm::dvec2(size_) * 2.0 - 1.0;
        return glm::normalize(forward_ + edge.x * right_ - edge.y * up_);
    }

    /// Top left corner of a pixel, numbered row by row from the top.
    [[nodiscard]] glm::dvec2 corner(std::size_t pixel) const {
        const std::size_t row = pixel / size_.x;
        const std::size_t column = pixel % size_.x;
        return {static_cast<double>(column), static_cast<double>(row)};
    }
    /// Nothing outside the picture. direction: unit.
    [[nodiscard]] std::optional<FilmPoint> project(const glm::dvec3& direction) const {
        const double along = glm::dot(direction, forward_);
        if (!(along > 0.0)) {
            return std::nullopt;
        }
        const glm::dvec3 on_plane = direction / along;
        const glm::dvec2 edge(glm::dot(on_plane, right_) / glm::dot(right_, right_),
                              -glm::dot(on_plane, up_) / glm::dot(up_, up_));
        const glm::dvec2 at = (edge + 1.0) * 0.5 * glm::dvec2(size_);
        if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < size_.x && at.y < size_.y)) {
            return std::nullopt;
        }
        return FilmPoint{static_cast<std::size_t>(at.y) * size_.x + static_cast<std::size_t>(at.x),
                         pixels_per_area_ / (along * along * along)};
    }
    /// One pixel's share of the picture.
    [[nodiscard]] double pixel_share() const {
        return 1.0 / (static_cast<double>(size_.x) * size_.y);
    }
    /// Density of a direction within the picture when its points are drawn evenly, 1/sr.
    [[nodiscard]] double density(const glm::dvec3& direction) const {
        const double along = glm::dot(direction, forward_);
        return pixels_per_area_ * pixel_share() / (along * along * along);
    }

  private:
    glm::dvec3 origin_;
    glm::uvec2 size_;
    glm::dvec3 right_{0.0}, up_{0.0}, forward_{0.0};
    double pixels_per_area_ = 0.0;  // of the plane at distance 1
};

}  // namespace raybundle
