// SPDX-License-Identifier: Apache-2.0
#include "view/pixels/picture_view.h"

#include <utility>

namespace raybundle {

void PictureView::upload() {
    block_.write(std::span(&std::as_const(values), 1), 0);
    bind();
}

PixelRectangle whole_picture(const layout::ViewParameters& view) {
    return {0, 0, static_cast<int>(view.size.x), static_cast<int>(view.size.y)};
}

PixelRectangle rectangle_of(std::span<const Bounds> boxes, const layout::ViewParameters& view) {
    glm::vec2 low(1e30F);
    glm::vec2 high(-1e30F);
    for (const Bounds& box : boxes) {
        if (box.empty()) {
            continue;
        }
        for (const glm::vec3& corner : corners(box)) {
            const glm::vec4 clip = view.clip_from_world * glm::vec4(corner, 1.0F);
            if (clip.w <= clip.z) {  // nearer than the picture's plane
                return whole_picture(view);
            }
            const glm::vec2 pixel = (glm::vec2(clip) / clip.w * 0.5F + 0.5F) * glm::vec2(view.size);
            low = glm::min(low, pixel);
            high = glm::max(high, pixel);
        }
    }
    if (low.x > high.x) {
        return {};
    }
    constexpr float group = 8.0F;
    const glm::vec2 first = glm::floor((low - 2.0F) / group) * group;
    const glm::vec2 last = glm::ceil((high + 2.0F) / group) * group;
    return dilated(first + 1.0F, last - 1.0F, whole_picture(view));
}

}  // namespace raybundle
