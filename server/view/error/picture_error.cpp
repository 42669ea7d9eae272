// SPDX-License-Identifier: Apache-2.0
#include "view/error/picture_error.h"

#include <algorithm>
#include <cmath>

namespace raybundle {

namespace {

/// Of a sky: less of it comes into closed rooms by what bundles do not resolve (`ClosedRoom*` finds
/// 2e-5), and is not worth a picture.
constexpr double unresolved_sky = 1e-4;

/// cd/m²: what eyes that see a lit room beside it take for black.
constexpr double faint_to_eyes = 1e-3;
constexpr double faint_beside_sky = 10.0 * unresolved_sky;  // noise of single lines that meet it
constexpr double faint_beside_before = 0.01;                // of what was shown before a change

constexpr std::uint64_t samples_of_start = 64;  // that light needs to come

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

void PictureError::forget() {
    statistics_ = {};
    light_before_ = 0.0;
}

void PictureError::begin_change() {
    if (statistics_.known && !statistics_.darker_than()) {
        light_before_ = statistics_.rms_luminance;
    }
    statistics_.known = false;
    statistics_.noise = sampling_noise_;
}

void PictureError::restart() {
    earlier_ = {};
    latest_ = {};
    error_before_ = std::min(statistics_.noise, 1.0);
    statistics_.samples = 0;
}

/// Light that is still to come has no scatter, nor has what a change has left behind.
SuspectedError PictureError::suspected_error(const PixelSums::Sums& sums,
                                             const Picture& picture) const {
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
        means.more = static_cast<double>(picture.samples) / static_cast<double>(earlier_.samples);
    }
    return suspected(means, picture.samples, picture.order, scene_.has_sky());
}

/// Remembers how bright the picture was when it had half as many samples or fewer.
void PictureError::note_light(std::uint64_t samples, double mean) {
    const LightThen now{samples, mean};
    if (now.samples < latest_.samples || now.samples == 0) {
        earlier_ = {};
        latest_ = {};
    }
    if (now.samples >= 2 * latest_.samples) {
        earlier_ = latest_;
        latest_ = now;
    }
}

void PictureError::judge_brightness(const PixelSums::Sums& sums, std::uint64_t samples) {
    const double sky = sky_luminance(scene_);
    const double unit = scene_.radiance_unit();
    statistics_.unresolved_light = unresolved_sky * sky;
    statistics_.faint_light =
        light_before_ > 0.0 || samples >= samples_of_start
            ? std::max({faint_to_eyes, faint_beside_sky * sky, faint_beside_before * light_before_})
            : 0.0;
    statistics_.mean_log_luminance = sums.light.z / sums.light.w + std::log(unit);
    statistics_.rms_luminance = std::sqrt(sums.light.y / sums.light.w) * unit;
}

void PictureError::evaluate(const PixelSums::Sums& sums, const Picture& picture,
                            SampleBatches& batches) {
    const glm::dvec4& light = sums.light;
    const glm::dvec4& detail = sums.detail;
    if (light.w <= 0.0) {
        return;
    }
    batches.take({sums.batches.x, sums.batches.y, sums.batches.z, sums.batches.w, sums.drift.z});
    judge_brightness(sums, picture.samples);
    statistics_.samples = picture.samples;
    statistics_.known = statistics_.known || picture.samples >= 2 * GROUP_SIZE;
    sampling_noise_ = light.y > 0.0 ? std::min(std::sqrt(light.x / light.y), 1.0) : 0.0;
    statistics_.discretisation =
        detail.z > 0.0 ? discretisation_error(detail.x / detail.z, detail.y / detail.z) *
                             unresolved_share(picture.grid)
                       : 0.0;
    note_light(picture.samples, sums.drift.y / light.w);
    const SuspectedError suspected = suspected_error(sums, picture);
    // How far it is from light that is still to come nobody knows.
    const bool unknown =
        suspected.missing > std::hypot(sampling_noise_, statistics_.discretisation);
    statistics_.noise = std::hypot(sampling_noise_, suspected.missing);
    ErrorInterval interval =
        error_interval(statistics_.noise, statistics_.discretisation, picture.samples,
                       picture.order, batches.luck(picture.order));
    if (picture.keeps_light) {
        interval = after_change(interval, picture.samples);
    }
    interval = with_left_over(interval, suspected.left_over);
    statistics_.noise = std::min(std::hypot(statistics_.noise, suspected.left_over), 1.0);
    statistics_.relative_error = interval.error;
    statistics_.error_low = interval.low;
    statistics_.error_high = unknown ? std::max(interval.high, 1.0) : interval.high;
}

float PictureError::automatic_exposure(std::optional<double> darker_than) const {
    // Mid-grey at the logarithmic mean, as Reinhard et al. 2002 ("Photographic Tone Reproduction").
    // A room that next to nothing of the sky gets into stays dark, and so does noise: at a tenth of
    // mid-grey.
    const double least = std::log(std::max(
        {unresolved_sky * sky_luminance(scene_), 10.0 * darker_than.value_or(0.0), 1e-30}));
    const double stops = -std::max(statistics_.mean_log_luminance, least) / std::log(2.0);
    return static_cast<float>(std::clamp(stops, -30.0, 30.0));
}

}  // namespace raybundle
