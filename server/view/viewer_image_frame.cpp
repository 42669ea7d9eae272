// SPDX-License-Identifier: Apache-2.0
// What a viewer's picture shows: frames, depths, and the light at the ends of mirrors' rays.
#include <cmath>
#include <string>

#include "gpu/gl_limits.h"
#include "view/specular/continued_view.h"
#include "view/viewer_image.h"

namespace raybundle {

namespace {

/// Lower end of a logarithmic colour scale: three decades.
constexpr float logarithmic_begin = 1e-3F;

}  // namespace

void ViewerImage::interpolate_vertices() {
    if (continued_) {
        continued_->shade();
    }
    see_air();
    store_.bind();
    bind_pixels();
    if (programs_.light == PixelLight::patches) {
        store_.bind_caustics_of_patches();
    }
    programs_.vertex_irradiance.set("vertex_count", scene_.vertex_count());
    programs_.vertex_irradiance.dispatch(scene_.vertex_count());
}

float ViewerImage::display_factor(float exposure) {
    return mid_grey * std::exp2(exposure);
}

void ViewerImage::compose(DisplayMode mode, float exposure, glm::uvec2 frame_size,
                          const ColourScale& scale) {
    interpolate_vertices();
    const float factor = mode == DisplayMode::photo
                             ? display_factor(exposure) * scene_.radiance_unit()
                             : scale.maximum;
    parameters_.display = {scene_.radiance_unit(), factor, 0.0F, scale.isolines};
    upload_view();
    frame_size = glm::clamp(frame_size, glm::uvec2(1), size_);
    const auto index = static_cast<std::size_t>(mode);
    const ShaderProgram& program =
        frame_size == size_ ? programs_.compose[index] : programs_.compose_scaled[index];
    program.set("triangle_count", scene_.triangle_count());
    program.set("frame_width", frame_size.x);
    program.set("frame_height", frame_size.y);
    if (mode != DisplayMode::photo) {
        program.set("scale_begin", scale.linear ? 0.0F : logarithmic_begin * scale.maximum);
    }
    program.dispatch(pixel_count(frame_size));
    frame_bytes_ = pixel_count(frame_size) * sizeof(std::uint32_t);
    const bool smoothed = frame_size == size_ && edges_->complete();
    frame_readback_->request(
        smoothed ? edges_->average(programs_.edges, frame_, mode == DisplayMode::photo) : frame_,
        frame_bytes_);
    check_picture();
}

/// Throws GlError where the driver has refused a command that the picture depends on.
void ViewerImage::check_picture() const {
    check_gl_errors("making a picture of " + std::to_string(size_.x) + "x" +
                    std::to_string(size_.y));
}

void ViewerImage::request_depths(std::uint32_t columns) {
    const glm::uvec2 points = DepthGrid::points_for(columns, size_);
    if (!depth_grid_ || depth_grid_->points() != points) {
        depth_grid_.emplace(points);
    }
    depth_grid_->request(programs_.depths, depths_, size_, near_distance());
}

void ViewerImage::shade_continued(const Buffer& radiance) {
    interpolate_vertices();
    parameters_.display = {1.0F, 1.0F, 0.0F, 0.0F};
    upload_view();
    radiance.bind_storage(BINDING_FRAME);
    programs_.compose_linear.set("triangle_count", scene_.triangle_count());
    programs_.compose_linear.set("frame_width", size_.x);
    programs_.compose_linear.set("frame_height", size_.y);
    programs_.compose_linear.dispatch(pixel_count(size_));
}

std::span<const std::uint8_t> ViewerImage::take() {
    return frame_readback_->take_as<std::uint8_t>();
}

}  // namespace raybundle
