// SPDX-License-Identifier: Apache-2.0
#include "view/pixels/visible_surfaces.h"

#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "gpu/gl_scope.h"
#include "trace/facet_tracer.h"
#include "view/filters/sub_samples.h"
#include "view/pixels/picture_view.h"
#include "view/pixels/pixel_buffers.h"

namespace raybundle {

namespace {

glm::uvec2 size_of(const layout::ViewParameters& view) {
    return {view.size.x, view.size.y};
}

/// Rays of the pixels of a rectangle, at a place from their centres, pixels. Depths along the
/// camera's axis are their lengths. width: of the picture that they go to. phase, period: of the
/// columns and rows that are followed.
RayGrid view_rays(const layout::ViewParameters& view, const glm::vec2& place,
                  const PixelRectangle& rectangle, std::size_t width,
                  const glm::ivec2& phase = glm::ivec2(0), int period = 1) {
    const glm::vec2 step = 2.0F / glm::vec2(size_of(view));
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

void end_raster() {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
}

}  // namespace

VisibleSurfaces::VisibleSurfaces(const GpuScene& scene, const ViewPrograms& programs,
                                 glm::uvec2 size)
    : scene_(scene), programs_(programs) {
    const auto width = static_cast<int>(size.x);
    const auto height = static_cast<int>(size.y);
    const bool traced = scene.traces(SeenAs::picture, pixel_count(size));
    ids_ = create_texture_2d("view surface ids", GL_R32UI, width, height);
    depths_ =
        create_texture_2d("view depths", traced ? GL_R32F : GL_DEPTH_COMPONENT32F, width, height);
    if (traced) {
        traced_.emplace(width, height, true);
    } else {
        framebuffer_ = create_framebuffer("view", ids_.get(), depths_.get());
    }
}

void VisibleSurfaces::see(const Look& look, const PixelRectangle& rectangle) {
    if (traced_) {
        trace_pixels(look, rectangle);
    } else {
        raster_pixels(look, rectangle);
    }
}

void VisibleSurfaces::see_shifted(const Look& look, const glm::vec2& place) {
    const PixelRectangle whole = whole_picture(look.view);
    if (traced_) {
        const GlScope scope("view sub-sample rays");
        const RayGrid grid = view_rays(look.view, place, whole, traced_->width());
        trace(look, std::span(&grid, 1), whole);
    } else {
        const GlScope scope("view sub-sample raster");
        begin_raster(look, whole);
        raster_shifted(look, programs_.raster, place, whole);
        end_raster();
    }
}

/// Follows rays to the textures that the raster would be in.
void VisibleSurfaces::trace(const Look& look, std::span<const RayGrid> grids,
                            const PixelRectangle& rectangle) {
    TraceRules rules = scene_.trace_rules(Place::now);
    rules.glass = GlassRule::shown;
    scene_.tracer()->nearest(grids, rules, traced_->result(look.near), look.hidden);
    traced_->upload(rectangle, ids_, &depths_);
}

void VisibleSurfaces::trace_pixels(const Look& look, const PixelRectangle& rectangle) {
    const GlScope scope("view rays");
    std::vector<RayGrid> grids;
    const unsigned period = look.grid == 1 ? 1 : STAGGER_PERIOD;
    for (unsigned y = 0; y < period; ++y) {
        for (unsigned x = 0; x < period; ++x) {
            const glm::vec2 place =
                look.grid == 1 ? glm::vec2(0.0F) : place_in_pixel(look.view, glm::uvec2(x, y));
            grids.push_back(view_rays(look.view, place, rectangle, traced_->width(),
                                      glm::ivec2(x, y), static_cast<int>(period)));
        }
    }
    trace(look, grids, rectangle);
}

void VisibleSurfaces::begin_raster(const Look& look, const PixelRectangle& rectangle) const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    glViewport(0, 0, static_cast<GLsizei>(look.view.size.x),
               static_cast<GLsizei>(look.view.size.y));
    glEnable(GL_SCISSOR_TEST);
    glScissor(rectangle.x0, rectangle.y0, rectangle.width(), rectangle.height());
    const GLuint no_hit[4] = {NO_HIT, 0, 0, 0};
    const float far_depth = 0.0F;
    glClearBufferuiv(GL_COLOR, 0, no_hit);
    glClearBufferfv(GL_DEPTH, 0, &far_depth);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
}

/// Draws the scene as seen at a place in each pixel, from its centre, pixels.
void VisibleSurfaces::raster_shifted(const Look& look, const ShaderProgram& program,
                                     const glm::vec2& place,
                                     const PixelRectangle& rectangle) const {
    const glm::uvec2 size = size_of(look.view);
    // A place at +x sees what the centre sees of a picture shifted by -x.
    const glm::vec2 shift = -2.0F * place / glm::vec2(size);
    const glm::mat4 clip_from_world =
        glm::translate(glm::mat4(1.0F), glm::vec3(shift, 0.0F)) * look.view.clip_from_world;
    program.use();
    program.set("clip_from_world", clip_from_world);
    scene_.draw(Place::now, narrowed(clip_from_world, rectangle, glm::ivec2(size)), true, program,
                look.hidden);
}

void VisibleSurfaces::raster_pixels(const Look& look, const PixelRectangle& rectangle) const {
    const GlScope scope("view raster");
    begin_raster(look, rectangle);
    if (look.grid == 1) {
        raster_shifted(look, programs_.raster, glm::vec2(0.0F), rectangle);
    } else {
        const ShaderProgram& program = programs_.raster_staggered;
        for (unsigned y = 0; y < STAGGER_PERIOD; ++y) {
            for (unsigned x = 0; x < STAGGER_PERIOD; ++x) {
                program.set("remainder_x", x);
                program.set("remainder_y", y);
                raster_shifted(look, program, place_in_pixel(look.view, glm::uvec2(x, y)),
                               rectangle);
            }
        }
    }
    end_raster();
}

}  // namespace raybundle
