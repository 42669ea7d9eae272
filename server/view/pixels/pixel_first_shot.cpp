// SPDX-License-Identifier: Apache-2.0
#include "view/pixels/pixel_first_shot.h"

#include "gpu/gl_scope.h"
#include "view/pixels/pixel_buffers.h"

namespace raybundle {

namespace {

/// A pass over a part of a picture.
void shoot_part(const ShaderProgram& program, const FirstShot& first_shot, unsigned pass,
                const PixelRectangle& part) {
    program.set("shot_pixels", glm::uvec4(part.x0, part.y0, part.x1, part.y1));
    first_shot.shoot(
        program, pass,
        static_cast<std::size_t>(part.width()) * static_cast<std::size_t>(part.height()));
}

}  // namespace

PixelFirstShot::PixelFirstShot(std::size_t pixels, bool glossy, bool many)
    : glossy_(glossy),
      light_("pixel first shot", (glossy ? 2 : 1) * pixels * sizeof(glm::vec4)),
      texture_(create_buffer_texture("pixel first shot", GL_RGBA32F, light_)) {
    if (many) {
        lamps_.emplace(pixels, glossy);
    } else {
        rest_ = Buffer("pixel first shot rest", light_.bytes());
    }
}

void PixelFirstShot::bind() const {
    light_.bind_storage(BINDING_PIXEL_FIRST_SHOT);
    glBindTextureUnit(UNIT_PIXEL_FIRST_SHOT, texture_.get());
}

void PixelFirstShot::shoot(const ViewPrograms& programs, const FirstShot& first_shot,
                           const layout::ViewParameters& view, Shows shows,
                           std::span<const Bounds> moved) {
    const GlScope scope("pixel first shot");
    if (lamps_) {
        if (shows == Shows::same_surfaces) {
            lamps_->change(programs, first_shot);
        } else {
            lamps_->begin(programs, first_shot, pixel_count(glm::uvec2(view.size)));
        }
        return;
    }
    using Reach = FirstShot::Reach;
    const Reach reach = first_shot.reach();
    const bool known = shows == Shows::moved_objects
                           ? taken_back_ && reach == Reach::moves
                           : shows == Shows::same_surfaces && taken_back_ && reach == Reach::lamps;
    rest_.bind_storage(BINDING_PIXEL_SHOT_REST);
    first_shot.set_uniforms(programs.first_shot);
    if (known) {
        add_changes(programs.first_shot, first_shot, view, moved);
    } else if (shows != Shows::same_surfaces || version_ != first_shot.version()) {
        shoot_part(programs.first_shot, first_shot, SHOT_ALL, whole_picture(view));
    }
    version_ = first_shot.version();
    taken_back_ = false;
}

/// Of pixels that have what there was before.
void PixelFirstShot::add_changes(const ShaderProgram& program, const FirstShot& first_shot,
                                 const layout::ViewParameters& view,
                                 std::span<const Bounds> moved) const {
    shoot_part(program, first_shot, SHOT_ADD, whole_picture(view));
    if (first_shot.reach() == FirstShot::Reach::moves) {
        if (const PixelRectangle rectangle = rectangle_of(moved, view); !rectangle.empty()) {
            program.set("renewed_material", NO_PATCH);
            shoot_part(program, first_shot, SHOT_RENEW, rectangle);
        }
        return;
    }
    if (glossy_) {
        for (const std::uint32_t material : first_shot.reflecting()) {
            program.set("renewed_material", material);
            shoot_part(program, first_shot, SHOT_RENEW, whole_picture(view));
        }
    }
}

void PixelFirstShot::take_back(const ViewPrograms& programs, const FirstShot& first_shot,
                               const layout::ViewParameters& view, bool stays,
                               FirstShot::Reach reach) {
    taken_back_ =
        !lamps_ && stays && version_ == first_shot.version() && first_shot.reach() == reach;
    if (!taken_back_) {
        return;
    }
    rest_.bind_storage(BINDING_PIXEL_SHOT_REST);
    first_shot.set_uniforms(programs.first_shot);
    shoot_part(programs.first_shot, first_shot, SHOT_TAKE_BACK, whole_picture(view));
}

}  // namespace raybundle
