// SPDX-License-Identifier: Apache-2.0
// What the pixels of a picture see of the scene: rasterised, or found by rays.
#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "gpu/gl_scope.h"
#include "trace/facet_tracer.h"
#include "view/filters/sub_samples.h"
#include "view/viewer_image.h"

namespace raybundle {

namespace {

/// Rays of the pixels of a rectangle, at a place from their centres, pixels. Depths along the
/// camera's axis are their lengths. width: of the picture that they go to. phase, period: of the
/// columns and rows that are followed.
RayGrid view_rays(const layout::ViewParameters& view, const glm::uvec2& size,
                  const glm::vec2& place, const PixelRectangle& rectangle, std::size_t width,
                  const glm::ivec2& phase = glm::ivec2(0), int period = 1) {
    const glm::vec2 step = 2.0F / glm::vec2(size);
    const glm::vec2 first = (glm::vec2(phase) + 0.5F + place) * step - 1.0F;
    RayGrid grid;
    grid.origin = glm::vec3(view.eye);
    grid.direction =
        glm::vec3(view.forward) + first.x * glm::vec3(view.right) + first.y * glm::vec3(view.up);
    grid.direction_x = static_cast<float>(period) * step.x * glm::vec3(view.right);
    grid.direction_y = static_cast<float>(period) * step.y * glm::vec3(view.up);
    grid.near = view.clip_from_world[3][2];
    const auto count = [&](int end, int from) { return (end - from + period - 1) / period; };
    grid.first = {count(rectangle.x0, phase.x), count(rectangle.y0, phase.y)};
    grid.last = {count(rectangle.x1, phase.x), count(rectangle.y1, phase.y)};
    grid.result = static_cast<std::size_t>(phase.y) * width + static_cast<std::size_t>(phase.x);
    grid.result_column = static_cast<std::size_t>(period);
    grid.result_row = grid.result_column * width;
    return grid;
}

}  // namespace

/// Follows rays to the textures that the raster would be in.
void ViewerImage::trace(std::span<const RayGrid> grids, const PixelRectangle& rectangle) {
    TraceRules rules = scene_.trace_rules(Place::now);
    rules.glass = GlassRule::shown;
    scene_.tracer()->nearest(grids, rules, traced_->result(near_distance()), camera_.hidden);
    traced_->upload(rectangle, surface_ids_, &depths_);
}

void ViewerImage::trace_pixels(const PixelRectangle& rectangle) {
    const GlScope scope("view rays");
    std::vector<RayGrid> grids;
    const unsigned period = grid_ == 1 ? 1 : STAGGER_PERIOD;
    for (unsigned y = 0; y < period; ++y) {
        for (unsigned x = 0; x < period; ++x) {
            const glm::vec2 place =
                grid_ == 1 ? glm::vec2(0.0F) : place_in_pixel(parameters_, glm::uvec2(x, y));
            grids.push_back(view_rays(parameters_, size_, place, rectangle, traced_->width(),
                                      glm::ivec2(x, y), static_cast<int>(period)));
        }
    }
    trace(grids, rectangle);
}

void ViewerImage::begin_raster(const PixelRectangle& rectangle) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    glViewport(0, 0, static_cast<GLsizei>(size_.x), static_cast<GLsizei>(size_.y));
    glEnable(GL_SCISSOR_TEST);
    glScissor(rectangle.x0, rectangle.y0, rectangle.width(), rectangle.height());
    const GLuint no_hit[4] = {NO_HIT, 0, 0, 0};
    const float far_depth = 0.0F;
    glClearBufferuiv(GL_COLOR, 0, no_hit);
    glClearBufferfv(GL_DEPTH, 0, &far_depth);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
}

void ViewerImage::end_raster() {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
}

/// Draws the scene as seen at a place in each pixel, from its centre, pixels.
void ViewerImage::raster_shifted(const ShaderProgram& program, const glm::vec2& place,
                                 const PixelRectangle& rectangle) const {
    // A place at +x sees what the centre sees of a picture shifted by -x.
    const glm::vec2 shift = -2.0F * place / glm::vec2(size_);
    const glm::mat4 clip_from_world =
        glm::translate(glm::mat4(1.0F), glm::vec3(shift, 0.0F)) * parameters_.clip_from_world;
    program.use();
    program.set("clip_from_world", clip_from_world);
    scene_.draw(Place::now, narrowed(clip_from_world, rectangle, glm::ivec2(size_)), true, program,
                camera_.hidden);
}

/// Finds what the pixels of a rectangle look at.
void ViewerImage::see_pixels(const PixelRectangle& rectangle) {
    if (traced_) {
        trace_pixels(rectangle);
    } else {
        raster_pixels(rectangle);
    }
}

/// Finds what is seen at the edge filter's next place.
void ViewerImage::see_sub_sample() {
    if (traced_) {
        const GlScope scope("view sub-sample rays");
        const RayGrid grid =
            view_rays(parameters_, size_, edges_->next_offset(), whole_picture(), traced_->width());
        trace(std::span(&grid, 1), whole_picture());
    } else {
        raster_sub_sample();
    }
}

/// Draws the scene as the pixels of a rectangle are looked at.
void ViewerImage::raster_pixels(const PixelRectangle& rectangle) const {
    const GlScope scope("view raster");
    begin_raster(rectangle);
    if (grid_ == 1) {
        raster_shifted(programs_.raster, glm::vec2(0.0F), rectangle);
    } else {
        const ShaderProgram& program = programs_.raster_staggered;
        for (unsigned y = 0; y < STAGGER_PERIOD; ++y) {
            for (unsigned x = 0; x < STAGGER_PERIOD; ++x) {
                program.set("remainder_x", x);
                program.set("remainder_y", y);
                raster_shifted(program, place_in_pixel(parameters_, glm::uvec2(x, y)), rectangle);
            }
        }
    }
    end_raster();
}

/// Draws the scene as seen at the edge filter's next place.
void ViewerImage::raster_sub_sample() const {
    const GlScope scope("view sub-sample raster");
    begin_raster(whole_picture());
    raster_shifted(programs_.raster, edges_->next_offset(), whole_picture());
    end_raster();
}

}  // namespace raybundle
