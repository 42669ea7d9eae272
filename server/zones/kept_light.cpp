// SPDX-License-Identifier: Apache-2.0
#include "zones/kept_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raybundle {

namespace {

constexpr double sample_deviation = 0.4;  // of a sample of weight 1, as in corrected_weight.glsl
constexpr double sure = 2.0;              // standard deviations that chance explains
/// Standard error of the levels beside that of the rays: of their model of gloss, slopes and
/// textures, relative.
constexpr double model_error = 0.02;

/// Samples that a mean with a relative error is worth.
double worth(double error) {
    return error > 0.0 ? sample_deviation * sample_deviation / (error * error) : 1e30;
}

/// Share of a difference that chance does not explain, given its standard error.
double believed(double difference, double error) {
    const double z = error > 0.0 ? std::abs(difference) / (sure * error) : 1e6;
    return z * z / (1.0 + z * z);
}

/// Brings the kept mean to the level that enters the zone.
KeptLevel first_level(const glm::dvec3& kept, const glm::dvec3& wanted, double wanted_error) {
    KeptLevel level;
    const double has = luminance_of(kept);
    const double target = luminance_of(wanted);
    if (has <= 0.0) {
        return level;
    }
    const double error = std::hypot(wanted_error, model_error * target);
    const double share = believed(has - target, error);
    for (int c = 0; c < 3; ++c) {
        const double factor = kept[c] > 0.0 ? wanted[c] / kept[c] : 1.0;
        level.scale[c] = std::max(1.0 + share * (std::min(factor, 1.0 / model_error) - 1.0), 0.0);
    }
    level.limit = worth(share * std::abs(has - target) / std::max(target, has * model_error));
    level.anew = target < has && level.limit < 1.0;
    return level;
}

}  // namespace

double variance_of_samples(double bounded_difference, double unit) {
    // With x the variance in units, the mean is 1 - E[1 / (1 + x chi²)], and that expectation is
    // sqrt(pi a) exp(a) erfc(sqrt(a)) with a = 1 / (2 x). It falls with x.
    const auto mean_at = [](double x) {
        const double a = 0.5 / x;
        // exp(a) erfc(sqrt(a)) by its asymptotic form where both leave the range of doubles
        const double scaled = a < 100.0 ? std::exp(a) * std::erfc(std::sqrt(a))
                                        : 1.0 / std::sqrt(std::numbers::pi * a) * (1.0 - 0.5 / a);
        return 1.0 - std::sqrt(std::numbers::pi * a) * scaled;
    };
    double low = 1e-3;
    double high = 1e3;
    for (int i = 0; i < 40; ++i) {
        const double middle = std::sqrt(low * high);
        (mean_at(middle) < bounded_difference ? low : high) = middle;
    }
    return unit * std::sqrt(low * high);
}

const std::vector<KeptLevel>& KeptLight::judge(std::span<const ZoneMeans> means,
                                               const ZoneLevels& levels) {
    const bool first = levels_.size() != means.size();
    if (first) {
        levels_.clear();
        for (std::size_t t = 0; t < means.size(); ++t) {
            levels_.push_back(means[t].loose ? KeptLevel{}
                                             : first_level(means[t].kept, levels.incident()[t],
                                                           levels.error()[t]));
        }
        find_doubt(means, levels);
        return levels_;
    }
    for (std::size_t t = 0; t < means.size(); ++t) {
        if (means[t].bounded_difference >= 0.0) {
            levels_[t].sample_variance = variance_of_samples(means[t].bounded_difference,
                                                             sample_deviation * sample_deviation);
        }
        const double kept = luminance_of(levels_[t].scale * means[t].kept);
        const double since = luminance_of(means[t].since);
        const double noise = levels.noise(static_cast<unsigned>(t));
        const double difference = std::abs(kept - since);
        if (noise <= 0.0 || difference <= sure * noise || kept <= 0.0) {
            continue;
        }
        const double error = std::sqrt(difference * difference - sure * sure * noise * noise);
        const double light = std::max(std::min(since, kept), model_error * kept);
        levels_[t].limit = std::min(levels_[t].limit, worth(error / light));
    }
    find_doubt(means, levels);
    return levels_;
}

void KeptLight::find_doubt(std::span<const ZoneMeans> means, const ZoneLevels& levels) {
    constexpr double darkest = 1e-3;     // of what was there before
    constexpr double small_zone = 0.02;  // of the area
    constexpr double large_error = 0.2;  // smaller ones, patches tell of themselves
    const auto light_of = [](const ZoneMeans& zone) {
        return std::max(luminance_of(zone.kept), luminance_of(zone.since));
    };
    double area = 0.0;
    double all_light = 0.0;
    for (const ZoneMeans& zone : means) {
        area += zone.area;
        all_light += light_of(zone);
    }
    doubt_ = 0.0;
    for (std::size_t t = 0; t < means.size(); ++t) {
        if (levels_[t].limit > std::min(worth(large_error), std::max(means[t].since_weight, 1.0)) ||
            means[t].area < small_zone * area || light_of(means[t]) < small_zone * all_light) {
            continue;
        }
        const double noise = levels.noise(static_cast<unsigned>(t));
        const double light =
            std::max(luminance_of(means[t].since), darkest * luminance_of(means[t].kept));
        const bool known = levels.known(static_cast<unsigned>(t));
        doubt_ = std::max(doubt_, known && light > 0.0 ? std::min(2.0 * noise / light, 1.0) : 1.0);
    }
}

}  // namespace raybundle
