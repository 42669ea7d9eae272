// SPDX-License-Identifier: Apache-2.0
#include "bundle/hemicube.h"

#include <algorithm>

#include "gpu/gl_scope.h"

namespace raybundle {

namespace {

/// Axes of a face in bundle coordinates; the same table as hemicube_face() in
/// shaders/bundle/hemicube.glsl.
struct FaceAxes {
    glm::vec3 right, up, forward;
};

FaceAxes face_axes(int face) {
    const glm::vec3 z(0, 0, 1);
    if (face == 0) {
        return {glm::vec3(0, 1, 0), glm::vec3(1, 0, 0), z};
    }
    const std::array<glm::vec3, 4> sides = {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0),
                                            glm::vec3(0, 1, 0), glm::vec3(0, -1, 0)};
    const glm::vec3 forward = sides[static_cast<std::size_t>(face - 1)];
    return {glm::cross(forward, z), z, forward};
}

/// Rows of clip_from_bundle for a face of n pixels: reversed infinite depth; sides show their upper
/// half only. Shifted, so that pixel centres show the sample points.
glm::mat4 clip_from_world(const BundleFrame& frame, int face, int n, float near_distance) {
    const FaceAxes axes = face_axes(face);
    const glm::mat3 world_from_bundle(frame.x, frame.y, frame.z);
    const glm::vec3 right = world_from_bundle * axes.right;
    const glm::vec3 up = world_from_bundle * axes.up;
    const glm::vec3 forward = world_from_bundle * axes.forward;
    const auto row = [&](const glm::vec3& v) { return glm::vec4(v, -glm::dot(v, frame.origin)); };
    const glm::vec4 w = row(forward);
    const glm::vec4 y = face == 0 ? row(up) : 2.0F * row(up) - w;
    const glm::vec2 pixel(2.0F / static_cast<float>(n),
                          (face == 0 ? 2.0F : 4.0F) / static_cast<float>(n));
    const glm::vec2 move = -frame.pixel_shift * pixel;
    return glm::transpose(
        glm::mat4(row(right) + move.x * w, y + move.y * w, glm::vec4(0, 0, 0, near_distance), w));
}

bool contains(const Bounds& box, const glm::vec3& p) {
    return glm::all(glm::greaterThanEqual(p, box.min)) && glm::all(glm::lessThanEqual(p, box.max));
}

}  // namespace

Hemicube::Hemicube(int n, const std::vector<std::string>& defines, bool traced)
    : n_((n + 15) / 16 * 16),
      surface_ids_(create_texture_2d("hemicube surface ids", GL_R32UI, n_, 3 * n_)),
      depths_(create_texture_2d("hemicube depths", traced ? GL_R32F : GL_DEPTH_COMPONENT32F, n_,
                                3 * n_)) {
    if (traced) {
        traced_.emplace(n_, 3 * n_, true);
        return;
    }
    framebuffer_ = create_framebuffer("hemicube", surface_ids_.get(), depths_.get());
    raster_ = ShaderProgram({"bundle_raster.vert", "bundle_nearest.frag"}, defines);
}

Hemicube::FaceRectangles Hemicube::full() const {
    FaceRectangles result;
    for (int face = 0; face < face_count; ++face) {
        result[static_cast<std::size_t>(face)] = {0, 0, n_, face_rows(face)};
    }
    return result;
}

Hemicube::FaceRectangles Hemicube::covering(const BundleFrame& frame,
                                            std::span<const Bounds> boxes) const {
    const FaceRectangles all = full();
    FaceRectangles result{};
    for (int face = 0; face < face_count; ++face) {
        const auto f = static_cast<std::size_t>(face);
        const FaceAxes axes = face_axes(face);
        glm::vec2 low(1e30F);
        glm::vec2 high(-1e30F);
        bool unbounded = false;
        for (const Bounds& box : boxes) {
            unbounded = unbounded || contains(box, frame.origin);
            int behind = 0;
            const float least = 1e-3F * glm::length(box.extent());
            glm::vec2 box_low(1e30F);
            glm::vec2 box_high(-1e30F);
            for (const glm::vec3& corner : corners(box)) {
                const glm::vec3 p = frame.to_bundle(corner);
                const float depth = glm::dot(p, axes.forward);
                if (depth < least) {
                    ++behind;
                    continue;
                }
                const glm::vec2 uv(glm::dot(p, axes.right) / depth, glm::dot(p, axes.up) / depth);
                box_low = glm::min(box_low, uv);
                box_high = glm::max(box_high, uv);
            }
            unbounded = unbounded || (behind > 0 && behind < 8);
            low = glm::min(low, box_low);
            high = glm::max(high, box_high);
        }
        if (unbounded) {
            result[f] = all[f];
        } else if (low.x <= high.x) {
            const auto half = 0.5F * static_cast<float>(n_);
            const float base = face == 0 ? half : 0.0F;  // sides start at the horizon
            result[f] = dilated({half + low.x * half, base + low.y * half},
                                {half + high.x * half, base + high.y * half}, all[f]);
        }
    }
    return result;
}

void Hemicube::draw(const GpuScene& scene, const BundleFrame& frame, float near_distance,
                    Place place, const FaceRectangles& rectangles) {
    if (traced_) {
        trace(scene, frame, near_distance, place, rectangles);
    } else {
        raster(scene, frame, near_distance, place, rectangles);
    }
}

/// Rays of the pixels of a face, as hemicube_direction() of shaders/bundle/hemicube.glsl has them.
RayGrid Hemicube::rays(const BundleFrame& frame, int face, float near_distance,
                       const PixelRectangle& rectangle) const {
    const FaceAxes axes = face_axes(face);
    const glm::mat3 world_from_bundle(frame.x, frame.y, frame.z);
    const float step = 2.0F / static_cast<float>(n_);
    const glm::vec2 first = (frame.pixel_shift + 0.5F) * step - glm::vec2(1, face == 0 ? 1 : 0);
    RayGrid grid;
    grid.origin = frame.origin;
    grid.direction = world_from_bundle * (axes.forward + first.x * axes.right + first.y * axes.up);
    grid.direction_x = world_from_bundle * axes.right * step;
    grid.direction_y = world_from_bundle * axes.up * step;
    grid.near = near_distance;
    grid.first = {rectangle.x0, rectangle.y0};
    grid.last = {rectangle.x1, rectangle.y1};
    grid.result_row = static_cast<std::size_t>(n_);
    grid.result = static_cast<std::size_t>(first_row(face)) * grid.result_row;
    grid.line_row = first_row(face);
    return grid;
}

void Hemicube::trace(const GpuScene& scene, const BundleFrame& frame, float near_distance,
                     Place place, const FaceRectangles& rectangles) {
    const GlScope scope("hemicube rays");
    std::vector<RayGrid> grids;
    for (int face = 0; face < face_count; ++face) {
        grids.push_back(
            rays(frame, face, near_distance, rectangles[static_cast<std::size_t>(face)]));
    }
    TraceRules rules = scene.trace_rules(place);
    rules.bundle = bundle_number(frame);
    scene.tracer()->nearest(grids, rules, traced_->result(near_distance));
    if (rectangles == full()) {
        traced_->upload({0, 0, n_, 3 * n_}, surface_ids_, &depths_);
        return;
    }
    for (int face = 0; face < face_count; ++face) {
        PixelRectangle r = rectangles[static_cast<std::size_t>(face)];
        r.y0 += first_row(face);
        r.y1 += first_row(face);
        traced_->upload(r, surface_ids_, &depths_);
    }
}

void Hemicube::raster(const GpuScene& scene, const BundleFrame& frame, float near_distance,
                      Place place, const FaceRectangles& rectangles) const {
    const GlScope scope("hemicube raster");
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.get());
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    raster_.use();
    raster_.set("facet_base", scene.facet_base(place));
    const GLuint no_hit[4] = {NO_HIT, 0, 0, 0};
    const float far_depth = 0.0F;
    for (int face = 0; face < face_count; ++face) {
        const PixelRectangle& r = rectangles[static_cast<std::size_t>(face)];
        if (r.empty()) {
            continue;
        }
        glViewport(0, first_row(face), n_, face_rows(face));
        glScissor(r.x0, first_row(face) + r.y0, r.width(), r.height());
        glClearBufferuiv(GL_COLOR, 0, no_hit);
        glClearBufferfv(GL_DEPTH, 0, &far_depth);
        const glm::mat4 clip = clip_from_world(frame, face, n_, near_distance);
        raster_.set("clip_from_world", clip);
        scene.draw(place, narrowed(clip, r, {n_, face_rows(face)}), true, raster_);
    }
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
}

void Hemicube::bind_textures() const {
    glBindTextureUnit(0, surface_ids_.get());
    glBindTextureUnit(1, depths_.get());
}

std::size_t Hemicube::bytes() const {
    return static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_) * 3 * 8;
}

}  // namespace raybundle
