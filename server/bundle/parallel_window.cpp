// SPDX-License-Identifier: Apache-2.0
#include "bundle/parallel_window.h"

namespace raybundle {

ParallelWindow make_parallel_window(int size, const glm::vec3& direction, float angle,
                                    const glm::vec2& shift, const glm::vec3& centre,
                                    float diameter) {
    ParallelWindow result;
    result.size = size;
    // One pixel more than the sphere needs, for the random shift.
    result.pixel_size = diameter / static_cast<float>(size - 2);
    result.depth = parallel_depth(diameter);
    result.frame = make_frame(centre, direction, angle);
    const float half = 0.5F * result.pixel_size * static_cast<float>(size - 2);
    const glm::vec2 corner = -glm::vec2(half) - result.pixel_size * (0.5F + shift * 0.999F);
    result.frame.origin = centre + result.frame.x * corner.x + result.frame.y * corner.y -
                          direction * (0.5F * result.depth);
    return result;
}

PixelRectangle ParallelWindow::covering(std::span<const Bounds> boxes) const {
    glm::vec2 low(1e30F);
    glm::vec2 high(-1e30F);
    for (const Bounds& box : boxes) {
        for (const glm::vec3& corner : corners(box)) {
            const glm::vec2 p = glm::vec2(frame.to_bundle(corner)) / pixel_size;
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    return dilated(low, high, full());
}

glm::mat4 ParallelWindow::clip_from_world(float depth_scale, float depth_offset) const {
    const float extent = pixel_size * static_cast<float>(size);
    const auto row = [&](const glm::vec3& v, float scale, float offset) {
        return glm::vec4(v * scale, offset - scale * glm::dot(v, frame.origin));
    };
    return glm::transpose(
        glm::mat4(row(frame.x, 2.0F / extent, -1.0F), row(frame.y, 2.0F / extent, -1.0F),
                  row(frame.z, depth_scale, depth_offset), glm::vec4(0, 0, 0, 1)));
}

}  // namespace raybundle
