// SPDX-License-Identifier: Apache-2.0
#include "bundle/plane_window.h"

#include <algorithm>

#include "gpu/gl_scope.h"

namespace raybundle {

namespace {

bool has_thin_walls(const std::vector<std::string>& defines) {
    return std::find(defines.begin(), defines.end(), "THIN_WALLS 1") != defines.end();
}

}  // namespace

PlaneWindow::PlaneWindow(int n, const std::vector<std::string>& defines, bool traced)
    : n_(n),
      exact_depths_(has_thin_walls(defines)),
      surface_ids_(create_texture_2d("plane surface ids", GL_R32UI, n, 2 * n)) {
    if (traced) {
        traced_.emplace(n, 2 * n, false);
        return;
    }
    depths_ = create_texture_2d("plane depths", GL_DEPTH_COMPONENT32F, n, 2 * n);
    framebuffer_ = create_framebuffer("plane window", surface_ids_.get(), depths_.get());
    raster_ = ShaderProgram(
        {"bundle_raster.vert", exact_depths_ ? "bundle_planes.frag" : "bundle_nearest.frag"},
        with(defines, "PARALLEL 1"));
}

void PlaneWindow::draw(const GpuScene& scene, const ParallelWindow& window, Place place) {
    if (traced_) {
        trace(scene, window, place);
    } else {
        raster(scene, window, place);
    }
}

/// Two rays a pixel, from the plane both ways. Surfaces that coincide back to back are a wall: the
/// front that faces the plane wins on either side.
void PlaneWindow::trace(const GpuScene& scene, const ParallelWindow& window, Place place) {
    const GlScope scope("plane rays");
    const BundleFrame& frame = window.frame;
    TraceRules rules = scene.trace_rules(place);
    rules.bundle = bundle_number(frame);
    for (const bool ahead : {false, true}) {
        RayGrid grid;
        grid.origin = frame.origin + 0.5F * window.pixel_size * (frame.x + frame.y) +
                      window.plane_depth * frame.z;
        grid.origin_x = window.pixel_size * frame.x;
        grid.origin_y = window.pixel_size * frame.y;
        grid.direction = ahead ? frame.z : -frame.z;
        grid.far = ahead ? window.depth - window.plane_depth : window.plane_depth;
        grid.last = {n_, n_};
        grid.result_row = static_cast<std::size_t>(n_);
        grid.line_row = ahead ? n_ : 0;
        grid.result = static_cast<std::size_t>(grid.line_row) * grid.result_row;
        rules.sides_along_rays = ahead;
        scene.tracer()->nearest(std::span(&grid, 1), rules, traced_->result(0.0F));
    }
    traced_->upload({0, 0, n_, 2 * n_}, surface_ids_, nullptr);
}

void PlaneWindow::raster(const GpuScene& scene, const ParallelWindow& window, Place place) const {
    const GlScope scope("plane raster");
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    const GLuint no_hit[4] = {NO_HIT, 0, 0, 0};
    const float farthest = 0.0F;
    glClearBufferuiv(GL_COLOR, 0, no_hit);
    glClearBufferfv(GL_DEPTH, 0, &farthest);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glEnable(GL_SCISSOR_TEST);
    raster_.use();
    raster_.set("facet_base", scene.facet_base(place));
    for (const bool ahead : {false, true}) {
        glViewport(0, ahead ? n_ : 0, n_, n_);
        glScissor(0, ahead ? n_ : 0, n_, n_);
        // Depth 1 at the plane, less away from it. Exact depths come from the fragments, which then
        // tell the sides of the plane apart too: nothing is clipped.
        const float scale = (ahead ? -1.0F : 1.0F) / window.depth;
        const glm::mat4 clip =
            exact_depths_ ? window.clip_from_world(1.0F / window.depth, 0.0F)
                          : window.clip_from_world(scale, 1.0F - scale * window.plane_depth);
        raster_.set("clip_from_world", clip);
        raster_.set("ahead", ahead ? 1 : 0);
        scene.draw(place, clip, true, raster_);
    }
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
}

void PlaneWindow::bind_textures() const {
    glBindTextureUnit(UNIT_SURFACE_IDS, surface_ids_.get());
}

std::size_t PlaneWindow::bytes() const {
    return static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_) * 2 * 8;
}

}  // namespace raybundle
