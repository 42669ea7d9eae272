// SPDX-License-Identifier: Apache-2.0
#include "view/error/error_interval.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace raybundle {
namespace {

/// 95 % of runs have their noise within exp(+-h) of the estimate. Most of it is the error itself,
/// which runs of the same length have by luck; what their samples say has next to no correlation
/// with that. The rest is the estimate's own, which fades like independent samples: see
/// few_samples() for what it was fitted to.
double noise_half_width(double noise, std::uint64_t samples, SampleOrder order, double luck) {
    constexpr double of_estimate = 1.25;
    constexpr double most = 0.6;
    const double independent = noise / std::sqrt(variance_of_mean(samples, order));
    return std::hypot(luck, of_estimate * std::min(independent, most));
}
/// The same of the discretisation part: between scenes. Below 0.5, else the upper end would fall
/// while noise grows.
constexpr double discretisation_half_width = 0.405;

double half_width(double noise, double discretisation, double of_noise) {
    const double n2 = noise * noise;
    const double d2 = discretisation * discretisation;
    return n2 + d2 > 0.0 ? std::hypot(n2 * of_noise, d2 * discretisation_half_width) / (n2 + d2)
                         : 0.0;
}

double upper_end(double noise, double discretisation, double of_noise) {
    return std::hypot(noise, discretisation) *
           std::exp(half_width(noise, discretisation, of_noise));
}

}  // namespace

/// Measured against path tracing at 32 to 384 samples. Shuffled, scenes differ: with a rough metal
/// floor there is next to no gain, with a normal map on a dielectric nearly the one of Lambert
/// scenes.
SequenceGain gain_of(SampleOrder order) {
    return order == SampleOrder::shuffled ? SequenceGain{0.05, 3.0} : SequenceGain{0.25, 6.5};
}

double variance_of_mean(std::uint64_t samples, SampleOrder order) {
    const SequenceGain gain = gain_of(order);
    const auto n = static_cast<double>(std::max<std::uint64_t>(samples, 1));
    const double beyond = std::max(n / gain.from_samples, 1.0);
    return std::pow(beyond, -2.0 * gain.exponent);
}

double few_samples(double independent_noise) {
    return std::exp(0.6 * std::min(independent_noise, 1.0));
}

double usual_luck(SampleOrder order) {
    return order == SampleOrder::shuffled ? 0.495 : 0.375;
}

double variance_of_patches(std::uint64_t samples, bool sky) {
    const auto n = static_cast<double>(std::max<std::uint64_t>(samples, 1));
    return 2.0 / (n * std::pow(n, sky ? -0.66 : -0.8));
}

namespace {

/// Of the iterate's level over that of the mean, by lag_of_mean()'s model.
double chance_ahead(double noise, std::uint64_t samples, SampleOrder order, bool sky) {
    return noise / std::sqrt(variance_of_patches(samples, sky) * variance_of_mean(samples, order));
}

}  // namespace

double lag_of_mean(double ahead, double noise, std::uint64_t samples, SampleOrder order, bool sky) {
    const double by_chance = chance_ahead(noise, samples, order, sky);
    return std::sqrt(std::max(ahead * ahead - by_chance * by_chance, 0.0));
}

SuspectedError suspected(const TwoMeans& means, std::uint64_t samples, SampleOrder order,
                         bool sky) {
    constexpr double most_left = 0.9;
    SuspectedError result;
    if (samples == 0) {
        return result;
    }
    const double most = std::exp(noise_half_width(means.noise, samples, order, usual_luck(order)));
    const double noise = most * means.noise * std::sqrt(variance_of_mean(samples, order));
    result.missing = lag_of_mean(means.ahead, noise, samples, order, sky);
    const double level = means.kept_share * chance_ahead(noise, samples, order, sky);
    const double scatter = most * means.noise_apart;
    const double wrong =
        std::sqrt(std::max(means.apart * means.apart - level * level - scatter * scatter, 0.0));
    double left = means.rises ? 0.0 : wrong;
    const double rising = means.rises ? wrong : 0.0;
    if (means.earlier > 0.0 && means.more > 1.0) {
        const double exponent = 0.5 + gain_of(order).exponent;
        const double chance = most * means.shown_noise * std::pow(means.more, exponent);
        const double step = means.earlier - 1.0;
        const double more =
            std::sqrt(std::max(step * step - chance * chance, 0.0)) / (means.more - 1.0);
        left = step > 0.0 ? std::hypot(left, more) : left;
        result.missing = step < 0.0 ? std::hypot(result.missing, more) : result.missing;
    } else {
        left = std::hypot(left, 0.5 * means.changed / static_cast<double>(samples));
    }
    // Relative to the brighter light that is to come.
    result.missing = std::hypot(result.missing, rising / (1.0 + rising));
    result.left_over = std::min(left, most_left);
    return result;
}

double discretisation_error(double at_edges, double elsewhere) {
    // Measured at 48x48 pixels against path tracing, means of many runs: smoothing leaves a quarter
    // of what it takes away, textures and normal maps err by half of their second differences.
    constexpr double left_at_edges = 0.28;
    constexpr double left_elsewhere = 0.48;
    return std::sqrt(left_at_edges * left_at_edges * at_edges +
                     left_elsewhere * left_elsewhere * elsewhere);
}

double unresolved_share(unsigned grid) {
    return std::pow(static_cast<double>(grid), -0.75);
}

ErrorInterval error_interval(double noise, double discretisation, std::uint64_t samples,
                             SampleOrder order, double luck) {
    const double error = std::hypot(noise, discretisation);
    const double factor =
        std::exp(half_width(noise, discretisation, noise_half_width(noise, samples, order, luck)));
    return {error, error / factor, error * factor};
}

ErrorInterval error_interval(double noise, double discretisation, std::uint64_t samples,
                             SampleOrder order) {
    return error_interval(noise, discretisation, samples, order, usual_luck(order));
}

ErrorInterval after_change(const ErrorInterval& interval, std::uint64_t samples) {
    constexpr double of_change = 0.4;
    constexpr double of_change_below = 0.9;
    constexpr double samples_of_change = 64.0;
    if (!(interval.error > 0.0) || samples == 0) {
        return interval;
    }
    const double own = std::log(interval.high / interval.error);
    const double newness =
        std::min(1.0, std::sqrt(samples_of_change / static_cast<double>(samples)));
    return {interval.error, interval.error * std::exp(-std::hypot(own, of_change_below * newness)),
            interval.error * std::exp(std::hypot(own, of_change * newness))};
}

ErrorInterval with_left_over(const ErrorInterval& interval, double share) {
    const double expected = 0.5 * share;
    return {std::hypot(interval.error, expected / (1.0 - expected)), interval.low,
            std::hypot(interval.high, share / (1.0 - share))};
}

namespace {

/// Logarithm of the density of what was measured, for a true error: Student's t, since the standard
/// error is an estimate. Where the largest differences were missed both come out too small, so that
/// true errors that are larger are ruled out less.
double measured_log_density(double error, double square, double standard_error) {
    const double freedom = error * error > square ? 8.0 : 30.0;
    const double t = (square - error * error) / standard_error;
    return -0.5 * (freedom + 1.0) * std::log1p(t * t / freedom);
}

/// Density of the logarithm of the error, as the samples say, up to a factor.
double said_density(double log_ratio, double deviation) {
    constexpr double far_off = 0.1;
    constexpr double deviation_far_off = 1.2;  // a factor of 3.3
    const auto normal = [log_ratio](double sigma) {
        return std::exp(-0.5 * log_ratio * log_ratio / (sigma * sigma)) / sigma;
    };
    return (1.0 - far_off) * normal(deviation) + far_off * normal(deviation_far_off);
}

}  // namespace

ErrorInterval measured_interval(const ErrorInterval& said, double square, double standard_error) {
    constexpr double two_sided = 1.96;  // standard deviations, 95 %
    constexpr int steps = 500;
    if (!(said.error > 0.0) || !(said.high > said.error) || !(standard_error > 0.0) ||
        !std::isfinite(standard_error)) {
        return said;
    }
    const double deviation = std::log(said.high / said.error) / two_sided;
    const double most = std::sqrt(std::max(square, 0.0) + 6.0 * standard_error);
    const double first = std::log(said.error) - 5.0;
    const double last = std::log(std::max(said.error, most)) + 3.0;
    const auto error_at = [&](double step) {
        return std::exp(first + (last - first) * step / steps);
    };
    std::array<double, steps + 1> below{};  // posterior up to each step
    for (int i = 0; i < steps; ++i) {
        const double error = error_at(i + 0.5);
        const double density = said_density(std::log(error / said.error), deviation) *
                               std::exp(measured_log_density(error, square, standard_error));
        below[static_cast<std::size_t>(i) + 1] = below[static_cast<std::size_t>(i)] + density;
    }
    const auto quantile = [&](double share) {
        const double sum = share * below.back();
        const auto at = std::lower_bound(below.begin() + 1, below.end(), sum);
        const auto step = static_cast<double>(at - below.begin());
        return error_at(step - (*at - sum) / std::max(*at - *(at - 1), 1e-300));
    };
    return {quantile(0.5), quantile(0.025), quantile(0.975)};
}

bool reachable(double discretisation, double target) {
    return discretisation * std::exp(discretisation_half_width) < target;
}

namespace {

/// Factor >= 1 from which on a falling function is at most a target that it reaches.
template <typename Function>
double first_factor(const Function& high_after, double target) {
    constexpr double most = 1e18;
    double low = 1.0;
    if (high_after(low) <= target) {
        return low;
    }
    double high = 2.0;
    while (high_after(high) > target && high < most) {
        low = high;
        high *= 2.0;
    }
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (high_after(middle) > target ? low : high) = middle;
    }
    return high;
}

}  // namespace

double samples_factor(double noise, double discretisation, double target, std::uint64_t samples,
                      SampleOrder order) {
    if (!reachable(discretisation, target)) {
        return std::numeric_limits<double>::infinity();
    }
    const double now = variance_of_mean(samples, order);
    return first_factor(
        [&](double factor) {
            const auto n =
                static_cast<std::uint64_t>(std::min(static_cast<double>(samples) * factor, 1e18));
            const double then = noise * std::sqrt(variance_of_mean(n, order) / (now * factor));
            return upper_end(then, discretisation,
                             noise_half_width(then, n, order, usual_luck(order)));
        },
        target);
}

double samples_factor(const MeasuredPicture& picture, double target, SampleOrder order) {
    // high / error when the interval first ends below a target: more paths will have been traced,
    // and the error is rather lower than it was to be expected. 25 runs to 2 % and their lengths
    // foreseen at a quarter of the way: in the mean 1.01 of them, standard deviation 12 %.
    constexpr double width_then = 1.15;
    const ErrorInterval& measured = picture.measured;
    if (measured.high <= target) {
        return 1.0;
    }
    const double width_now = measured.high / measured.error;
    // Samples may say that more is unresolved than there is error.
    const double known_part = std::min(picture.discretisation, measured.error);
    const double part_then = std::min(picture.discretisation_then, known_part);
    const double narrowest = std::min(width_now, width_then);
    if (narrowest * part_then >= target) {
        return std::numeric_limits<double>::infinity();
    }
    const auto squared = [](double x) { return x * x; };
    const double lucky = squared(measured.error) - squared(known_part);
    const double exponent = 0.5 + gain_of(order).exponent;
    return first_factor(
        [&](double factor) {
            const double old = 1.0 / factor;
            const double noise = (1.0 - old) * squared(picture.noise) + old * lucky;
            return (narrowest + (width_now - narrowest) * old) *
                   std::sqrt(noise * std::pow(factor, -2.0 * exponent) + squared(part_then));
        },
        target);
}

}  // namespace raybundle
