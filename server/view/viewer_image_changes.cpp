// SPDX-License-Identifier: Apache-2.0
// How a viewer's picture follows a special iteration phase.
#include "view/viewer_image.h"

namespace raybundle {

void ViewerImage::clear_increments() const {
    delta_.clear();
    if (gloss_delta_.bytes() > 0) {
        gloss_delta_.clear();
    }
}

void ViewerImage::begin_special(std::uint32_t moved_object) {
    refresh_geometry(store_.kept_share(parameters_.weights.x), moved_object);
    clear_increments();
}

void ViewerImage::begin_surfaces(const glm::vec3& scale, std::span<const std::uint32_t> reflecting,
                                 bool redraw) {
    if (redraw) {
        refresh_geometry(1.0F);
    }
    clear_increments();
    upload_view();
    store_.bind();
    bind_pixels();
    const auto run = [&](const glm::vec3& factor, std::uint32_t material) {
        programs_.scale.set("factor", factor);
        programs_.scale.set("material", material);
        programs_.scale.dispatch(std::size_t{size_.x} * size_.y);
    };
    parameters_.constant *= glm::vec4(scale, 0.0F);
    if (scale != glm::vec3(1.0F)) {
        run(scale, NO_PATCH);
    }
    for (const std::uint32_t material : reflecting) {
        if (gloss_.bytes() > 0) {
            run(glm::vec3(1.0F), material);
        }
    }
}

void ViewerImage::scale_special(float factor) {
    upload_view();
    store_.bind();
    bind_pixels();
    programs_.scale_delta.set("factor", glm::vec3(factor));
    programs_.scale_delta.set("material", NO_PATCH);
    programs_.scale_delta.dispatch(std::size_t{size_.x} * size_.y);
}

void ViewerImage::end_special(float bundles_noise, float most_weight) {
    upload_view();
    store_.bind();
    bind_pixels();
    batches_.clear();
    parameters_.weights.y = 0.0F;
    scene_.set_move(programs_.correct);
    programs_.correct.set("bundles_noise", bundles_noise);
    programs_.correct.set("most_weight", most_weight);
    programs_.correct.dispatch(std::size_t{size_.x} * size_.y);
}

}  // namespace raybundle
