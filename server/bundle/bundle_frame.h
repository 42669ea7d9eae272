// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "scene/scene.h"

namespace raybundle {

/// Where a bundle starts and how it is turned: right-handed, z along the shooter's normal or along
/// the parallel direction. Shifted world space, metres.
struct BundleFrame {
    glm::vec3 origin{0.0F};
    glm::vec3 x{1.0F, 0.0F, 0.0F};
    glm::vec3 y{0.0F, 1.0F, 0.0F};
    glm::vec3 z{0.0F, 0.0F, 1.0F};
    /// Offset of a hemicube's sample points from the centres of its pixels, pixels, [-0.5, 0.5).
    glm::vec2 pixel_shift{0.0F};

    [[nodiscard]] glm::vec3 to_bundle(const glm::vec3& world) const {
        const glm::vec3 d = world - origin;
        return {glm::dot(x, d), glm::dot(y, d), glm::dot(z, d)};
    }
};

/// A frame with the given unit z, turned about it by an angle (radians).
inline BundleFrame make_frame(const glm::vec3& origin, const glm::vec3& z, float angle) {
    const glm::vec3 helper =
        std::abs(z.x) < 0.57F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
    const glm::vec3 u = glm::normalize(glm::cross(helper, z));
    const glm::vec3 v = glm::cross(z, u);
    BundleFrame frame;
    frame.origin = origin;
    frame.z = z;
    frame.x = std::cos(angle) * u + std::sin(angle) * v;
    frame.y = glm::cross(z, frame.x);
    return frame;
}

/// The eight corners of a box.
inline std::array<glm::vec3, 8> corners(const Bounds& box) {
    std::array<glm::vec3, 8> result;
    for (unsigned i = 0; i < 8; ++i) {
        result[i] = {(i & 1U) != 0 ? box.max.x : box.min.x, (i & 2U) != 0 ? box.max.y : box.min.y,
                     (i & 4U) != 0 ? box.max.z : box.min.z};
    }
    return result;
}

/// Pixels [x0, x1) x [y0, y1).
struct PixelRectangle {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    [[nodiscard]] int width() const { return x1 > x0 ? x1 - x0 : 0; }
    [[nodiscard]] int height() const { return y1 > y0 ? y1 - y0 : 0; }
    [[nodiscard]] bool empty() const { return width() == 0 || height() == 0; }
    bool operator==(const PixelRectangle&) const = default;
};

/// Smallest rectangle inside `limit` that holds points [low, high], grown by one pixel on each
/// side.
inline PixelRectangle dilated(const glm::vec2& low, const glm::vec2& high,
                              const PixelRectangle& limit) {
    const auto clamped = [](float value, int a, int b) {
        return static_cast<int>(
            std::fmin(std::fmax(value, static_cast<float>(a)), static_cast<float>(b)));
    };
    return {clamped(std::floor(low.x) - 1.0F, limit.x0, limit.x1),
            clamped(std::floor(low.y) - 1.0F, limit.y0, limit.y1),
            clamped(std::ceil(high.x) + 1.0F, limit.x0, limit.x1),
            clamped(std::ceil(high.y) + 1.0F, limit.y0, limit.y1)};
}

/// Restricts a view to a rectangle of a picture of `size` pixels; the rest need not be drawn.
inline glm::mat4 narrowed(const glm::mat4& clip_from_world, const PixelRectangle& rectangle,
                          const glm::ivec2& size) {
    const glm::vec2 low = 2.0F * glm::vec2(rectangle.x0, rectangle.y0) / glm::vec2(size) - 1.0F;
    const glm::vec2 high = 2.0F * glm::vec2(rectangle.x1, rectangle.y1) / glm::vec2(size) - 1.0F;
    const glm::vec2 scale = 2.0F / (high - low);
    const glm::vec2 shift = -0.5F * (high + low) * scale;
    glm::mat4 rows = glm::transpose(clip_from_world);
    rows[0] = scale.x * rows[0] + shift.x * rows[3];
    rows[1] = scale.y * rows[1] + shift.y * rows[3];
    return glm::transpose(rows);
}

}  // namespace raybundle
