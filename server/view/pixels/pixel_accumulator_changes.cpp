// SPDX-License-Identifier: Apache-2.0
// How the pixels of a picture follow changes, and what they say.
#include "view/pixels/pixel_accumulator.h"

namespace raybundle {

/// Puts what the pixels have apart from what will come in, or joins both again.
void PixelAccumulator::keep_light(bool apart) {
    upload_view();
    bind_with_solution();
    buffers_->bind_kept();
    programs_.keep.set("split", apart);
    programs_.keep.dispatch(pixel_count(size_));
    buffers_->bind();
    progress_.keeps_light = apart;
}

void PixelAccumulator::join_kept() {
    if (progress_.keeps_light) {
        keep_light(false);
    }
}

void PixelAccumulator::complete_start() {
    upload_view();
    bind();
    programs_.complete.dispatch(pixel_count(size_));
    forget_lobes();  // rays have seen nothing but lamps
}

void PixelAccumulator::begin_change() {
    join_kept();
    forget_lobes();
    sums_.forget_request();
}

void PixelAccumulator::take_back_shot(bool stays, FirstShot::Reach reach) {
    if (shot_) {
        upload_view();
        bind_with_solution();
        shot_->take_back(programs_, *store_.first_shot(), view(), stays && progress_.has_picture,
                         reach);
    }
}

void PixelAccumulator::plan_differences(std::span<const BundleRays> bundles,
                                        std::span<const Bounds> boxes) {
    upload_view();
    bind_with_solution();
    lists_->affected.find(programs_.affected_tiles, bundles, boxes);
}

void PixelAccumulator::receive_special(const ViewPrograms::Receive& programs,
                                       const Context& context) {
    const AffectedTiles& affected = lists_->affected;
    programs.all.set("first_of_quad", context.number % 4);
    if (context.difference == NO_PATCH) {
        affected.dispatch_all(programs.all);
        if (buffers_->glossy()) {
            programs.glossy.set("listed_tiles", false);
            lists_->specular->dispatch(programs.glossy);
        }
        return;
    }
    affected.dispatch(programs.all, context.difference, false);
    if (buffers_->glossy()) {
        affected.dispatch(programs.glossy, context.difference, true);
    }
}

void PixelAccumulator::begin_surfaces(const glm::vec3& scale,
                                      std::span<const std::uint32_t> reflecting, bool redrawn) {
    clear_increments();
    upload_view();
    bind_with_solution();
    const auto run = [&](const glm::vec3& factor, std::uint32_t material) {
        programs_.scale.set("factor", factor);
        programs_.scale.set("material", material);
        programs_.scale.dispatch(pixel_count(size_));
    };
    if (!redrawn) {
        shoot(Shows::same_surfaces);
    }
    view_.values.constant *= glm::vec4(scale, 0.0F);
    if (scale != glm::vec3(1.0F)) {
        run(scale, NO_PATCH);
    }
    for (const std::uint32_t material : reflecting) {
        if (buffers_->glossy()) {
            run(glm::vec3(1.0F), material);
        }
    }
}

void PixelAccumulator::scale_special(float factor) {
    upload_view();
    bind_with_solution();
    programs_.scale_delta.set("factor", glm::vec3(factor));
    programs_.scale_delta.set("material", NO_PATCH);
    programs_.scale_delta.dispatch(pixel_count(size_));
}

void PixelAccumulator::end_special(float bundles_noise, float max_weight) {
    upload_view();
    bind_with_solution();
    restart_scatter();
    scene_.set_move(programs_.correct);
    programs_.correct.set("bundles_noise", bundles_noise);
    programs_.correct.set("most_weight", max_weight);
    programs_.correct.dispatch(pixel_count(size_));
    keep_light(true);
    forget_lobes();
    look_into_lobes();
}

void PixelAccumulator::light_vertices() const {
    bind_with_solution();
    if (programs_.light == PixelLight::patches) {
        store_.bind_caustics_of_patches();
    }
    vertex_irradiance_.interpolate(programs_.vertex_irradiance);
}

void PixelAccumulator::set_display(const glm::vec4& display) {
    view_.values.display = display;
    upload_view();
}

void PixelAccumulator::write_radiance(const Buffer& target) const {
    const ShaderProgram& program = programs_.compose_linear;
    target.bind_storage(BINDING_FRAME);
    program.set("triangle_count", scene_.triangle_count());
    program.set("frame_width", size_.x);
    program.set("frame_height", size_.y);
    program.dispatch(pixel_count(size_));
}

void PixelAccumulator::sum_statistics(double error_before) {
    const std::uint64_t samples = progress_.scatter_samples;
    const ShaderProgram& program = programs_.statistics;
    program.set("triangle_count", scene_.triangle_count());
    program.set("logarithm_floor", 1e-4F / scene_.radiance_unit());
    program.set("error_before", static_cast<float>(error_before));
    program.set("variance_of_mean", static_cast<float>(variance_of_mean(samples, sample_order())));
    program.set("variance_of_patches",
                static_cast<float>(variance_of_patches(samples, scene_.has_sky())));
    program.set("fresh_share", samples < GROUP_SIZE ? 2.0F : 0.16F);
    sums_.end_batch(program, {samples, view().weights.y, view().weights.z}, sample_order());
    PixelSums::run(program);
}

std::vector<glm::vec4> PixelAccumulator::read_irradiance() const {
    std::vector<glm::vec4> result(pixel_count(size_));
    std::vector<glm::vec4> kept(result.size());
    buffers_->irradiance().read<glm::vec4>(result);
    buffers_->kept().read<glm::vec4>(kept);
    for (std::size_t i = 0; i < result.size(); ++i) {
        const glm::vec4 sum = result[i] + glm::vec4(0.0F, 0.0F, 0.0F, view().weights.x) + kept[i];
        const float scale = sum.w > 0.0F ? scene_.radiance_unit() / sum.w : 0.0F;
        result[i] = glm::vec4(glm::vec3(sum + view().constant) * scale, sum.w);
    }
    return result;
}

std::size_t PixelAccumulator::bytes() const {
    return buffers_->bytes() + vertex_irradiance_.bytes() + confidence_->bytes() +
           lists_->crowded.bytes() + lists_->affected.bytes() +
           (gloss_rays_ ? gloss_rays_->bytes() : 0) + (shot_ ? shot_->bytes() : 0);
}

}  // namespace raybundle
