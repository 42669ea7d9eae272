// SPDX-License-Identifier: Apache-2.0
// The light of punctual lights at the pixels of a viewer's picture.
#include "gpu/gl_scope.h"
#include "view/viewer_image.h"

namespace raybundle {

/// Light of punctual lights at the pixels.
void ViewerImage::shoot_first(Shows shows) {
    if (store_.first_shot() == nullptr) {
        return;
    }
    const GlScope scope("pixel first shot");
    const FirstShot& first_shot = *store_.first_shot();
    if (lamps_) {
        if (shows == Shows::same_surfaces) {
            lamps_->change(programs_, first_shot);
        } else {
            lamps_->begin(programs_, first_shot, pixel_count(size_));
        }
        store_.bind();
        bind_pixels();
        return;
    }
    using Reach = FirstShot::Reach;
    const Reach reach = first_shot.reach();
    const bool known =
        shows == Shows::moved_objects
            ? shot_taken_back_ && reach == Reach::moves
            : shows == Shows::same_surfaces && shot_taken_back_ && reach == Reach::lamps;
    shot_rest_.bind_storage(BINDING_PIXEL_SHOT_REST);
    first_shot.set_uniforms(programs_.first_shot);
    if (known) {
        shoot_changes(first_shot);
    } else if (shows != Shows::same_surfaces || shot_version_ != first_shot.version()) {
        shoot(first_shot, SHOT_ALL, whole_picture());
    }
    shot_version_ = first_shot.version();
    shot_taken_back_ = false;
    store_.bind();
    bind_pixels();
}

/// A pass over a part of the picture.
void ViewerImage::shoot(const FirstShot& first_shot, unsigned pass,
                        const PixelRectangle& part) const {
    programs_.first_shot.set("shot_pixels", glm::uvec4(part.x0, part.y0, part.x1, part.y1));
    first_shot.shoot(
        programs_.first_shot, pass,
        static_cast<std::size_t>(part.width()) * static_cast<std::size_t>(part.height()));
}

/// Of pixels that have what there was before.
void ViewerImage::shoot_changes(const FirstShot& first_shot) {
    if (first_shot.reach() == FirstShot::Reach::moves) {
        shoot(first_shot, SHOT_ADD, whole_picture());
        if (const PixelRectangle rectangle = rectangle_of_moved(); !rectangle.empty()) {
            programs_.first_shot.set("renewed_material", NO_PATCH);
            shoot(first_shot, SHOT_RENEW, rectangle);
        }
        return;
    }
    shoot(first_shot, SHOT_ADD, whole_picture());
    if (gloss_.bytes() > 0) {
        for (const std::uint32_t material : first_shot.reflecting()) {
            programs_.first_shot.set("renewed_material", material);
            shoot(first_shot, SHOT_RENEW, whole_picture());
        }
    }
}

void ViewerImage::begin_moves() {
    take_back_shot(ends_ == nullptr, FirstShot::Reach::moves);
}

void ViewerImage::begin_lights() {
    take_back_shot(true, FirstShot::Reach::lamps);
    if (continued() != nullptr) {
        continued()->begin_lights();
    }
}

/// Light of punctual lights that a change reaches, as it was. stays: what the pixels show does.
void ViewerImage::take_back_shot(bool stays, FirstShot::Reach reach) {
    const FirstShot* const first_shot = store_.first_shot();
    shot_taken_back_ = first_shot != nullptr && !lamps_ && stays && has_picture_ &&
                       shot_version_ == first_shot->version() && first_shot->reach() == reach;
    if (!shot_taken_back_) {
        return;
    }
    upload_view();
    store_.bind();
    bind_pixels();
    shot_rest_.bind_storage(BINDING_PIXEL_SHOT_REST);
    first_shot->set_uniforms(programs_.first_shot);
    shoot(*first_shot, SHOT_TAKE_BACK, whole_picture());
}

/// Of many lamps some more at the pixels: a picture whose camera may move on soon waits until it
/// rests, and does a part at a time.
void ViewerImage::look_at_lamps() {
    constexpr std::uint64_t resting_samples = 8;
    constexpr std::size_t points = 4096;  // some 10 ms on a core
    constexpr std::size_t points_at_rest = 16 * points;
    if (!lamps_ || (!rests_ && samples_ < resting_samples)) {
        return;
    }
    store_.bind();
    bind_pixels();
    lamps_->advance(programs_, *store_.first_shot(), rests_ ? points_at_rest : points);
    store_.bind();
    bind_pixels();
}

}  // namespace raybundle
