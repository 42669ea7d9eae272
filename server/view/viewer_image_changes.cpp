// SPDX-License-Identifier: Apache-2.0
// How a viewer's picture follows a special iteration phase.
#include "view/specular/continued_view.h"
#include "view/viewer_image.h"

namespace raybundle {

void ViewerImage::clear_increments() const {
    delta_.clear();
    if (gloss_delta_.bytes() > 0) {
        gloss_delta_.clear();
    }
}

/// Puts what the pixels have apart from what will come in, or joins both again.
void ViewerImage::keep_light(bool apart) {
    upload_view();
    store_.bind();
    bind_pixels();
    kept_.bind_storage(BINDING_PIXEL_DELTA);
    programs_.keep.set("split", apart);
    programs_.keep.dispatch(pixel_count(size_));
    delta_.bind_storage(BINDING_PIXEL_DELTA);
    keeping_ = apart;
}

void ViewerImage::join_kept() {
    if (keeping_) {
        keep_light(false);
    }
}

/// What was known of the error was of another scene.
void ViewerImage::begin_change() {
    join_kept();
    forget_lobes();
    if (statistics_.known && !statistics_.darker_than()) {
        light_before_ = statistics_.rms_luminance;
    }
    statistics_.known = false;
    statistics_.noise = sampling_noise_;
    requested_samples_ = 0;
}

void ViewerImage::begin_special() {
    begin_change();
    if (has_picture_ && store_.first_shot() == nullptr) {
        refresh_moved();
    } else {
        refresh_geometry(store_.kept_share(parameters_.weights.x), Shows::moved_objects);
    }
    clear_increments();
}

/// Smallest rectangle that holds all that has moved at both places: with whole work groups of
/// view_resolve.comp, and rounding.
PixelRectangle ViewerImage::rectangle_of_moved() const {
    glm::vec2 low(1e30F);
    glm::vec2 high(-1e30F);
    for (const Bounds& box : scene_.moved_bounds()) {
        if (box.empty()) {
            continue;
        }
        for (const glm::vec3& corner : corners(box)) {
            const glm::vec4 clip = parameters_.clip_from_world * glm::vec4(corner, 1.0F);
            if (clip.w <= clip.z) {
                return whole_picture();
            }
            const glm::vec2 pixel = (glm::vec2(clip) / clip.w * 0.5F + 0.5F) * glm::vec2(size_);
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
    return dilated(first + 1.0F, last - 1.0F, whole_picture());
}

/// What the rows of a rectangle show becomes what they showed before.
void ViewerImage::copy_rows(const PixelRectangle& rectangle) const {
    const auto copy = [&](const Buffer& from, const Buffer& to, std::size_t bytes_a_pixel) {
        const std::size_t row = size_.x * bytes_a_pixel;
        const auto offset = static_cast<GLintptr>(static_cast<std::size_t>(rectangle.y0) * row);
        glCopyNamedBufferSubData(
            from.get(), to.get(), offset, offset,
            static_cast<GLsizeiptr>(static_cast<std::size_t>(rectangle.height()) * row));
    };
    copy(pixels_, old_pixels_, sizeof(layout::PixelSurface));
    copy(irradiance_, old_irradiance_, sizeof(glm::vec4));
    if (gloss_.bytes() > 0) {
        copy(gloss_, old_gloss_, sizeof(glm::vec4));
    }
}

/// The camera rests, and objects are elsewhere: only where they are and were the picture differs,
/// and all other pixels keep what they have to the bit.
void ViewerImage::refresh_moved() {
    restart_scatter();
    samples_ = 0;
    crowded_->restart();
    if (continued_) {
        continued_->refresh(parameters_, camera_, 1.0F);
    }
    const PixelRectangle rectangle = rectangle_of_moved();
    if (rectangle.empty()) {
        return;
    }
    old_ = {parameters_.clip_from_world, size_, glm::vec3(parameters_.eye), parameters_.weights.x,
            glm::vec3(parameters_.constant)};
    upload_view();
    see_pixels(rectangle);
    copy_rows(rectangle);
    store_.bind();
    bind_pixels();
    bind_old_picture();
    resolve(programs_.resolve_moved, rectangle, 1.0F);
    edges_->restart();
}

void ViewerImage::plan_differences(std::span<const BundleRays> bundles,
                                   std::span<const Bounds> boxes) {
    upload_view();
    store_.bind();
    bind_pixels();
    affected_->find(programs_.affected_tiles, bundles, boxes);
    if (continued() != nullptr) {
        continued()->plan_differences(bundles, boxes);
    }
}

void ViewerImage::receive_special(const ViewPrograms::Receive& programs, const Context& context) {
    const bool glossy = gloss_.bytes() > 0;
    programs.all.set("first_of_quad", context.number % 4);
    if (context.difference == NO_PATCH) {
        affected_->dispatch_all(programs.all);
        if (glossy) {
            programs.glossy.set("listed_tiles", false);
            specular_->dispatch(programs.glossy);
        }
        return;
    }
    affected_->dispatch(programs.all, context.difference, false);
    if (glossy) {
        affected_->dispatch(programs.glossy, context.difference, true);
    }
}

void ViewerImage::begin_surfaces(const glm::vec3& scale, std::span<const std::uint32_t> reflecting,
                                 bool redraw) {
    begin_change();
    if (redraw) {
        refresh_geometry(1.0F, Shows::same_surfaces);
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
    if (!redraw) {
        shoot_first(Shows::same_surfaces);
    }
    parameters_.constant *= glm::vec4(scale, 0.0F);
    if (scale != glm::vec3(1.0F)) {
        run(scale, NO_PATCH);
    }
    for (const std::uint32_t material : reflecting) {
        if (gloss_.bytes() > 0) {
            run(glm::vec3(1.0F), material);
        }
    }
    if (continued() != nullptr) {
        continued()->begin_surfaces(scale, reflecting, false);
    }
}

void ViewerImage::scale_special(float factor) {
    upload_view();
    store_.bind();
    bind_pixels();
    programs_.scale_delta.set("factor", glm::vec3(factor));
    programs_.scale_delta.set("material", NO_PATCH);
    programs_.scale_delta.dispatch(std::size_t{size_.x} * size_.y);
    if (continued() != nullptr) {
        continued()->scale_special(factor);
    }
}

void ViewerImage::end_special(float bundles_noise, float most_weight) {
    upload_view();
    store_.bind();
    bind_pixels();
    restart_scatter();
    scene_.set_move(programs_.correct);
    programs_.correct.set("bundles_noise", bundles_noise);
    programs_.correct.set("most_weight", most_weight);
    programs_.correct.dispatch(std::size_t{size_.x} * size_.y);
    keep_light(true);
    forget_lobes();
    look_into_lobes();
    if (continued() != nullptr) {
        continued()->end_special(bundles_noise, most_weight);
    }
}

}  // namespace raybundle
