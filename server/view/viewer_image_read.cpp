// SPDX-License-Identifier: Apache-2.0
// What is read from a viewer's picture: its light, and single pixels.
#include <bit>

#include "view/specular/continued_view.h"
#include "view/viewer_image.h"

namespace raybundle {

std::vector<glm::vec4> ViewerImage::read_radiance() {
    interpolate_vertices();
    parameters_.display = {scene_.radiance_unit(), 1.0F, 0.0F, 0.0F};
    upload_view();
    Buffer linear("linear frame", pixel_count(size_) * sizeof(glm::vec4));
    linear.bind_storage(BINDING_FRAME);
    programs_.compose_linear.set("triangle_count", scene_.triangle_count());
    programs_.compose_linear.set("frame_width", size_.x);
    programs_.compose_linear.set("frame_height", size_.y);
    programs_.compose_linear.dispatch(pixel_count(size_));
    if (edges_->complete()) {
        linear = edges_->average_linear(programs_.edges, linear);
    }
    std::vector<glm::vec4> result(pixel_count(size_));
    linear.read<glm::vec4>(result);
    check_picture();
    return result;
}

std::optional<PixelProbe> ViewerImage::probe(glm::uvec2 pixel) {
    return probe(std::span(&pixel, 1)).front();
}

std::vector<std::optional<PixelProbe>> ViewerImage::probe(std::span<const glm::uvec2> pixels) {
    std::vector<layout::PickResult> picks(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const glm::uvec2 pixel = glm::min(pixels[i], size_ - 1U);
        picks[i].position.x = std::bit_cast<float>((size_.y - 1 - pixel.y) * size_.x + pixel.x);
    }
    interpolate_vertices();
    parameters_.display = {scene_.radiance_unit(), 1.0F, 0.0F, 0.0F};
    upload_view();
    auto buffer = Buffer::from<layout::PickResult>("probes", picks);
    buffer.bind_storage(BINDING_PICK);
    programs_.probe.set("triangle_count", scene_.triangle_count());
    programs_.probe.set("error_before", static_cast<float>(error_before_));
    programs_.probe.set("variance_of_mean",
                        static_cast<float>(noise_factor_ * noise_factor_ *
                                           variance_of_mean(scatter_samples_, sample_order())));
    programs_.probe.dispatch(pixels.size());
    buffer.read<layout::PickResult>(picks);
    check_picture();
    std::vector<std::optional<PixelProbe>> found(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        if (picks[i].position.w > 0.0F) {
            found[i] = from_pick(picks[i]);
        }
    }
    return found;
}

PixelProbe ViewerImage::from_pick(const layout::PickResult& pick) const {
    PixelProbe result;
    result.position = glm::vec3(pick.position) + scene_.origin();
    result.normal = glm::vec3(pick.normal);
    result.object = std::bit_cast<std::uint32_t>(pick.normal.w);
    result.patch = std::bit_cast<std::uint32_t>(pick.irradiance.w);
    result.irradiance = glm::vec3(pick.irradiance) * scene_.radiance_unit();
    result.radiance = glm::vec3(pick.radiance) * scene_.radiance_unit();
    if (pick.radiance.w >= 0.0F) {
        result.relative_error = static_cast<double>(pick.radiance.w);
    }
    return result;
}

std::vector<glm::vec4> ViewerImage::read_irradiance() const {
    std::vector<glm::vec4> result(pixel_count(size_));
    std::vector<glm::vec4> kept(result.size());
    irradiance_.read<glm::vec4>(result);
    kept_.read<glm::vec4>(kept);
    for (std::size_t i = 0; i < result.size(); ++i) {
        const glm::vec4 sum =
            result[i] + glm::vec4(0.0F, 0.0F, 0.0F, parameters_.weights.x) + kept[i];
        const float scale = sum.w > 0.0F ? scene_.radiance_unit() / sum.w : 0.0F;
        result[i] = glm::vec4(glm::vec3(sum + parameters_.constant) * scale, sum.w);
    }
    return result;
}

std::size_t ViewerImage::bytes() const {
    std::size_t sum = pixel_count(full_size_) * 8 + edges_->bytes() + affected_->bytes() +
                      confidence_->bytes() + crowded_->bytes() +
                      (continued_ ? continued_->bytes() : 0) +
                      (depth_grid_ ? depth_grid_->bytes() : 0) + (air_ ? air_->bytes() : 0) +
                      (gloss_rays_ ? gloss_rays_->bytes() : 0);
    for (const Buffer* buffer : {&pixels_, &old_pixels_, &irradiance_, &old_irradiance_, &delta_,
                                 &kept_, &scatter_, &vertex_irradiance_, &frame_, &gloss_,
                                 &old_gloss_, &gloss_delta_, &first_shot_, &shot_rest_}) {
        sum += buffer->bytes();
    }
    return sum;
}

}  // namespace raybundle
