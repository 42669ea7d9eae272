// SPDX-License-Identifier: Apache-2.0
// What a viewer's picture says of its own error and brightness.
#include <algorithm>
#include <cmath>

#include "view/specular/continued_view.h"
#include "view/viewer_image.h"

namespace raybundle {

namespace {

/// Of a sky: less of it comes into closed rooms by what bundles do not resolve (`ClosedRoom*` finds
/// 2e-5), and is not worth a picture.
constexpr double unresolved_sky = 1e-4;

/// cd/m²: what eyes that see a lit room beside it take for black.
constexpr double faint_to_eyes = 1e-3;
constexpr double faint_beside_sky = 10.0 * unresolved_sky;  // noise of single lines that meet it
constexpr double faint_beside_before = 0.01;                // of what was shown before a change

/// Mean luminance of the sky towards the corners of a cube, cd/m².
double sky_luminance(const GpuScene& scene) {
    double sum = 0.0;
    for (unsigned corner = 0; corner < 8 && scene.has_sky(); ++corner) {
        const glm::vec3 towards((corner & 1U) != 0 ? 1.0F : -1.0F,
                                (corner & 2U) != 0 ? 1.0F : -1.0F,
                                (corner & 4U) != 0 ? 1.0F : -1.0F);
        sum += static_cast<double>(luminance(scene.sky_towards(glm::normalize(towards))));
    }
    return 0.125 * sum * static_cast<double>(scene.radiance_unit());
}

}  // namespace

std::optional<double> ImageStatistics::darker_than() const {
    if (!known || faint_light <= 0.0) {
        return std::nullopt;
    }
    const double most = rms_luminance * (1.0 + std::min(error_high, 1.0));
    if (unresolved_light > 0.0 && rms_luminance <= unresolved_light) {
        return std::max(most, unresolved_light);
    }
    const bool may_be_none = error_high >= 1.0 || rms_luminance <= 0.0;
    if (!may_be_none || most > faint_light) {
        return std::nullopt;
    }
    return rms_luminance > 0.0 ? most : faint_light;
}

/// What the pixels show is another thing from now on, or of other accuracy.
void ViewerImage::restart_scatter() {
    scatter_.clear();
    earlier_ = {};
    latest_ = {};
    error_before_ = std::min(statistics_.noise, 1.0);
    parameters_.weights.y = 0.0F;
    parameters_.weights.z = 0.0F;
    scatter_samples_ = 0;
    batches_.restart();
    confidence_->restart();
    tell_confidence();
    detail_samples_ = 0;
    requested_samples_ = 0;
    statistics_.samples = 0;
}

/// The sums of a coarser picture of the same view.
void ViewerImage::refine_scatter(const Buffer& coarse, glm::uvec2 coarse_size) {
    const glm::uvec2 coarse_probes = (coarse_size + 3U) / 4U;
    const glm::uvec2 probes = (size_ + 3U) / 4U;
    const ShaderProgram& program = programs_.scatter_refine;
    program.set("factor", size_.x / coarse_size.x);
    program.set("probes", static_cast<std::uint32_t>(pixel_count(probes)));
    program.set("probe_columns", probes.x);
    program.set("coarse_columns", coarse_probes.x);
    program.set("coarse_rows", coarse_probes.y);
    coarse.bind_storage(BINDING_FRAME);
    scatter_.bind_storage(BINDING_PIXEL_SCATTER);
    program.dispatch(pixel_count(probes));
}

void ViewerImage::request_statistics() {
    if (continued() != nullptr) {
        continued()->error_before_ = error_before_;
        continued()->request_statistics();
    }
    interpolate_vertices();
    parameters_.display = {scene_.radiance_unit(), 1.0F, 0.0F, 0.0F};
    upload_view();
    programs_.statistics.set("triangle_count", scene_.triangle_count());
    programs_.statistics.set("logarithm_floor", 1e-4F / scene_.radiance_unit());
    programs_.statistics.set("error_before", static_cast<float>(error_before_));
    programs_.statistics.set(
        "variance_of_mean", static_cast<float>(variance_of_mean(scatter_samples_, sample_order())));
    programs_.statistics.set("variance_of_patches", static_cast<float>(variance_of_patches(
                                                        scatter_samples_, scene_.has_sky())));
    programs_.statistics.set("fresh_share", scatter_samples_ < GROUP_SIZE ? 2.0F : 0.16F);
    batches_.end({scatter_samples_, parameters_.weights.y, parameters_.weights.z}, sample_order());
    programs_.statistics.set("batch_begin", batches_.begin());
    programs_.statistics.set("batch_squares", batches_.squares());
    programs_.statistics.dispatch(statistics_groups * 64);
    if (ends_ == nullptr &&
        scatter_samples_ >= std::max<std::uint64_t>(2 * detail_samples_, 2 * GROUP_SIZE)) {
        measure_detail();
    }
    statistics_readback_->request(statistics_buffer_, statistics_buffer_.bytes());
    requested_samples_ = scatter_samples_;
}

SampleOrder ViewerImage::sample_order() const {
    return scene_.reflectance().any_glossy() ? SampleOrder::shuffled : SampleOrder::low_discrepancy;
}

/// What is finer than the pixels changes little: measured when there are twice as many samples.
void ViewerImage::measure_detail() {
    Buffer unsmoothed("pixels not smoothed", pixel_count(size_) * sizeof(glm::vec4));
    unsmoothed.bind_storage(BINDING_FRAME);
    programs_.compose_linear.set("triangle_count", scene_.triangle_count());
    programs_.compose_linear.set("frame_width", size_.x);
    programs_.compose_linear.set("frame_height", size_.y);
    programs_.compose_linear.dispatch(pixel_count(size_));
    const Buffer smoothed =
        edges_->complete() ? edges_->average_linear(programs_.edges, unsmoothed) : Buffer();
    unsmoothed.bind_storage(BINDING_FRAME);
    (edges_->complete() ? smoothed : unsmoothed).bind_storage(BINDING_SMOOTHED);
    programs_.detail.dispatch(statistics_groups * 64);
    detail_samples_ = scatter_samples_;
}

ViewerImage::StatisticsSums ViewerImage::statistics_sums() {
    StatisticsSums sums;
    const auto parts = statistics_readback_->take_as<glm::vec4>();
    for (std::size_t i = 0; i < statistics_groups; ++i) {
        sums.light += glm::dvec4(parts[i]);
        sums.detail += glm::dvec4(parts[statistics_groups + i]);
        sums.drift += glm::dvec4(parts[2 * statistics_groups + i]);
        sums.difference += glm::dvec4(parts[3 * statistics_groups + i]);
        sums.batches += glm::dvec4(parts[4 * statistics_groups + i]);
    }
    return sums;
}

const ImageStatistics& ViewerImage::statistics() {
    if (statistics_readback_->ready()) {
        finish_statistics();
    }
    return statistics_;
}

void ViewerImage::finish_statistics() {
    StatisticsSums sums = statistics_sums();
    if (continued() != nullptr) {
        const StatisticsSums behind = continued()->statistics_sums();
        sums.light += behind.light;
        sums.drift += behind.drift;
        sums.difference += behind.difference;
        sums.batches += behind.batches;
    }
    evaluate(sums);
}

/// What has not been reached yet has no scatter, nor has what a change has left behind.
SuspectedError ViewerImage::suspected_error(const StatisticsSums& sums) const {
    if (!(sums.light.y > 0.0) || !(sums.drift.y > 0.0)) {
        return {};
    }
    const auto relative = [&](double square) { return std::sqrt(square / sums.light.y); };
    TwoMeans means;
    means.apart = relative(sums.difference.x);
    means.noise_apart = relative(sums.difference.y);
    means.rises = sums.difference.z < 0.0;
    means.kept_share = relative(sums.difference.w);
    means.changed = relative(sums.drift.w);
    means.ahead = sums.drift.x / sums.drift.y;
    means.noise = relative(sums.drift.z);
    means.shown_noise = sampling_noise_;
    if (earlier_.light > 0.0) {
        means.earlier = earlier_.light * sums.light.w / sums.drift.y;
        means.more =
            static_cast<double>(requested_samples_) / static_cast<double>(earlier_.samples);
    }
    return suspected(means, requested_samples_, sample_order(), scene_.has_sky());
}

/// Noise of the mean over what the scatter of its samples says. Light that was kept over a change
/// has no part in that.
double ViewerImage::noise_factor(const StatisticsSums& sums) const {
    if (!(sums.light.y > 0.0)) {
        return 1.0;
    }
    const double own_share = 1.0 - std::min(std::sqrt(sums.difference.w / sums.light.y), 1.0);
    const double independent = std::sqrt(sums.drift.z / sums.light.y);
    return std::sqrt(batches_.correlation()) * few_samples(own_share * independent);
}

/// Remembers how bright the picture was when it had half as many samples or fewer.
void ViewerImage::note_light(double mean) {
    const LightThen now{requested_samples_, mean};
    if (now.samples < latest_.samples || now.samples == 0) {
        earlier_ = {};
        latest_ = {};
    }
    if (now.samples >= 2 * latest_.samples) {
        earlier_ = latest_;
        latest_ = now;
    }
}

void ViewerImage::evaluate(const StatisticsSums& sums) {
    const glm::dvec4& sum = sums.light;
    const glm::dvec4& detail = sums.detail;
    if (sum.w <= 0.0) {
        return;
    }
    constexpr std::uint64_t samples_of_start = 64;  // that light needs to come
    statistics_.samples = requested_samples_;
    batches_.take({sums.batches.x, sums.batches.y, sums.batches.z, sums.batches.w, sums.drift.z});
    const double sky = sky_luminance(scene_);
    statistics_.unresolved_light = unresolved_sky * sky;
    statistics_.faint_light =
        light_before_ > 0.0 || requested_samples_ >= samples_of_start
            ? std::max({faint_to_eyes, faint_beside_sky * sky, faint_beside_before * light_before_})
            : 0.0;
    statistics_.known = statistics_.known || requested_samples_ >= 2 * GROUP_SIZE;
    const double unit = scene_.radiance_unit();
    sampling_noise_ = sum.y > 0.0 ? std::min(std::sqrt(sum.x / sum.y) * noise_factor_, 1.0) : 0.0;
    statistics_.discretisation =
        detail.z > 0.0 ? discretisation_error(detail.x / detail.z, detail.y / detail.z) *
                             unresolved_share(grid_)
                       : 0.0;
    note_light(sums.drift.y / sum.w);
    const SuspectedError suspected = suspected_error(sums);
    // How far it is from light that is still to come nobody knows.
    const bool unknown =
        suspected.missing > std::hypot(sampling_noise_, statistics_.discretisation);
    statistics_.noise = std::hypot(sampling_noise_, suspected.missing);
    ErrorInterval interval =
        error_interval(statistics_.noise, statistics_.discretisation, requested_samples_,
                       sample_order(), batches_.luck(sample_order()));
    if (keeping_) {
        interval = after_change(interval, requested_samples_);
    }
    interval = with_left_over(interval, suspected.left_over);
    statistics_.noise = std::min(std::hypot(statistics_.noise, suspected.left_over), 1.0);
    statistics_.relative_error = interval.error;
    statistics_.error_low = interval.low;
    statistics_.error_high = unknown ? std::max(interval.high, 1.0) : interval.high;
    statistics_.mean_log_luminance = sum.z / sum.w + std::log(unit);
    statistics_.rms_luminance = std::sqrt(sum.y / sum.w) * unit;
}

float ViewerImage::automatic_exposure(std::optional<double> darker_than) const {
    // Mid-grey at the logarithmic mean, as Reinhard et al. 2002 ("Photographic Tone Reproduction").
    // A room that next to nothing of the sky gets into stays dark, and so does noise: at a tenth of
    // mid-grey.
    const double least = std::log(std::max(
        {unresolved_sky * sky_luminance(scene_), 10.0 * darker_than.value_or(0.0), 1e-30}));
    const double stops = -std::max(statistics_.mean_log_luminance, least) / std::log(2.0);
    return static_cast<float>(std::clamp(stops, -30.0, 30.0));
}

}  // namespace raybundle
