// SPDX-License-Identifier: Apache-2.0
#include "view/frame_composer.h"

#include <cmath>

namespace raybundle {

namespace {

constexpr float mid_grey = 0.18F;

/// Lower end of a logarithmic colour scale: three decades.
constexpr float logarithmic_begin = 1e-3F;

}  // namespace

void FrameComposer::allocate(glm::uvec2 size) {
    frame_ = Buffer("frame", pixel_count(size) * sizeof(std::uint32_t));
    readback_.emplace("frame readback", frame_.bytes());
}

float FrameComposer::display_factor(float exposure) {
    return mid_grey * std::exp2(exposure);
}

void FrameComposer::compose(const GpuScene& scene, const ViewPrograms& programs,
                            PixelAccumulator& pixels, const EdgeFilter& edges,
                            const PictureLook& look, glm::uvec2 frame_size) {
    const bool photo = look.mode == DisplayMode::photo;
    const float factor =
        photo ? display_factor(look.exposure) * scene.radiance_unit() : look.scale.maximum;
    pixels.set_display(
        {scene.radiance_unit(), factor, look.cut ? 1.0F : 0.0F, look.scale.isolines});
    frame_size = glm::clamp(frame_size, glm::uvec2(1), pixels.size());
    const bool whole = frame_size == pixels.size();
    const auto index = static_cast<std::size_t>(look.mode);
    const ShaderProgram& program = whole ? programs.compose[index] : programs.compose_scaled[index];
    frame_.bind_storage(BINDING_FRAME);
    program.set("triangle_count", scene.triangle_count());
    program.set("frame_width", frame_size.x);
    program.set("frame_height", frame_size.y);
    if (!photo) {
        program.set("scale_begin",
                    look.scale.linear ? 0.0F : logarithmic_begin * look.scale.maximum);
    }
    program.dispatch(pixel_count(frame_size));
    const bool smoothed = whole && edges.complete();
    readback_->request(smoothed ? edges.average(programs.edges, frame_, photo) : frame_,
                       pixel_count(frame_size) * sizeof(std::uint32_t));
}

void FrameComposer::request_depths(const ShaderProgram& program, const Texture2D& depths,
                                   glm::uvec2 picture, std::uint32_t columns, float near) {
    const glm::uvec2 points = DepthGrid::points_for(columns, picture);
    if (!depths_ || depths_->points() != points) {
        depths_.emplace(points);
    }
    depths_->request(program, depths, picture, near);
}

}  // namespace raybundle
