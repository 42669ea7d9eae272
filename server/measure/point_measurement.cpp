// SPDX-License-Identifier: Apache-2.0
#include "measure/point_measurement.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "measure/solid_test.h"

namespace raybundle {
namespace {

constexpr double outside = 0.025;  // of each end of an interval

constexpr std::size_t degrees = PointMeasurement::batches - 1;

Interval around(double value, double half) {
    return {value, std::max(value - half, 0.0), value + half};
}

using BatchNumbers = std::array<double, PointMeasurement::batches>;

double mean_of(const BatchNumbers& numbers) {
    return std::accumulate(numbers.begin(), numbers.end(), 0.0) / PointMeasurement::batches;
}

double variance_of_mean(const BatchNumbers& numbers) {
    const double mean = mean_of(numbers);
    double sum = 0.0;
    for (const double number : numbers) {
        sum += (number - mean) * (number - mean);
    }
    return sum / (double{PointMeasurement::batches} * degrees);
}

/// Of two intervals of numbers that are not negative.
Interval ratio(const Interval& part, const Interval& whole) {
    if (!(whole.value > 0.0)) {
        return {0.0, 0.0, 1.0};
    }
    return {part.value / whole.value, whole.high > 0.0 ? part.low / whole.high : 0.0,
            whole.low > 0.0 ? std::min(part.high / whole.low, 1.0) : 1.0};
}

}  // namespace

PointMeasurement::PointMeasurement(std::shared_ptr<const MeasuredScene> scene,
                                   std::vector<CalculationPoint> points,
                                   const MeasurementSettings& settings)
    : scene_(std::move(scene)),
      points_(std::move(points)),
      settings_(settings),
      inside_(points_.size()),
      fixed_(points_.size()),
      sums_(points_.size() * batches) {
    if (points_.empty() || points_.size() > most_points) {
        throw std::invalid_argument("a measurement has 1 to 4096 points");
    }
    for (const CalculationPoint& point : points_) {
        receivers_.emplace_back(settings.quantity, point.direction);
        places_.push_back(in_front_of_surface(scene_->rays, scene_->rays.from_world(point.position),
                                              receivers_.back().axis()));
    }
    const PointPaths paths(*scene_);
    tbb::parallel_for(std::size_t{0}, points_.size(), [&](std::size_t i) {
        inside_[i] = inside_solid(scene_->rays, places_[i]) ? 1 : 0;
        fixed_[i] = inside_[i] != 0 ? 0.0 : paths.fixed(places_[i], receivers_[i]);
    });
    measured_ = static_cast<std::size_t>(std::count(inside_.begin(), inside_.end(), 0));
}

void PointMeasurement::add_samples(std::size_t count) {
    const std::uint64_t first = steps_;
    const std::size_t all = points_.size();
    // Of one point at a time only one round runs, so that sums are added in order.
    for (std::uint64_t begin = first; begin < first + count;) {
        const std::uint64_t end = std::min(first + count, (begin / all + 1) * all);
        tbb::parallel_for(begin, end,
                          [&](std::uint64_t step) { add_sample(step % all, step / all); });
        begin = end;
    }
    steps_ = first + count;
}

void PointMeasurement::add_sample(std::size_t point, std::uint64_t round) {
    if (inside(point)) {
        return;
    }
    const PointPaths paths(*scene_);
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
        PixelSampler sampler(settings_.seed, static_cast<std::uint32_t>(point), batch,
                             static_cast<std::uint32_t>(round));
        const ArrivedLight light =
            paths.sample(places_[point], receivers_[point], !settings_.direct, sampler);
        if (std::isfinite(light.direct) && std::isfinite(light.reflected)) {
            ArrivedLight& sum = sums_[point * batches + batch];
            sum.direct += light.direct;
            sum.reflected += light.reflected;
        }
    }
}

ArrivedLight PointMeasurement::batch_mean(std::size_t point, std::uint32_t batch) const {
    const double share =
        settings_.factor / static_cast<double>(std::max<std::uint64_t>(rounds_of(point), 1));
    const ArrivedLight& sum = sums_[point * batches + batch];
    return {settings_.factor * fixed_[point] + share * sum.direct, share * sum.reflected};
}

PointMeasurement::Scatter PointMeasurement::scatter(std::size_t point) const {
    std::array<double, batches> direct{};
    std::array<double, batches> reflected{};
    std::array<double, batches> all{};
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
        const ArrivedLight light = batch_mean(point, batch);
        direct[batch] = light.direct;
        reflected[batch] = light.reflected;
        all[batch] = light.direct + light.reflected;
    }
    return {mean_of(all), variance_of_mean(all), variance_of_mean(direct),
            variance_of_mean(reflected)};
}

/// Where reflected light has less variance than that of all points it gets theirs.
std::vector<PointMeasurement::Scatter> PointMeasurement::scatters() const {
    std::vector<Scatter> result(points_.size());
    double common = 0.0;
    for (std::size_t point = 0; point < points_.size(); ++point) {
        if (!inside(point)) {
            result[point] = scatter(point);
            common += result[point].reflected / static_cast<double>(measured_);
        }
    }
    for (Scatter& found : result) {
        found.variance = std::max(found.variance, found.direct + common);
    }
    return result;
}

PointMeasurement::Scatter PointMeasurement::scatter_of_mean() const {
    std::array<double, batches> means{};
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
        for (std::size_t point = 0; point < points_.size(); ++point) {
            const ArrivedLight light = inside(point) ? ArrivedLight{} : batch_mean(point, batch);
            means[batch] += (light.direct + light.reflected) / static_cast<double>(measured_);
        }
    }
    return {mean_of(means), variance_of_mean(means), 0.0, 0.0};
}

std::vector<Interval> PointMeasurement::values() const {
    const double quantile = student_quantile(1.0 - outside, degrees);
    std::vector<Interval> result;
    for (const Scatter& found : scatters()) {
        result.push_back(around(found.mean, quantile * found.error()));
    }
    return result;
}

PointMeasurement::Extremes PointMeasurement::extremes(double beyond) const {
    std::vector<BatchEstimate> estimates;
    const std::vector<Scatter> all_points = scatters();
    for (std::size_t point = 0; point < points_.size(); ++point) {
        if (!inside(point)) {
            estimates.push_back({all_points[point].mean, all_points[point].error()});
        }
    }
    const auto not_negative = [](Interval found) {
        found.low = std::max(found.low, 0.0);
        return found;
    };
    const Scatter mean = scatter_of_mean();
    return {around(mean.mean, student_quantile(1.0 - beyond, degrees) * mean.error()),
            not_negative(interval_of_smallest(estimates, beyond, degrees)),
            not_negative(interval_of_largest(estimates, beyond, degrees))};
}

MeasurementSummary PointMeasurement::summary() const {
    const Extremes single = extremes(outside);
    const Extremes joint = extremes(0.5 * outside);
    return {single.mean, single.minimum, single.maximum, ratio(joint.minimum, joint.mean),
            ratio(joint.minimum, joint.maximum)};
}

double PointMeasurement::relative_error() const {
    const double mean = rounds() < least_rounds || measured_ == 0 ? 0.0 : scatter_of_mean().mean;
    if (!(mean > 0.0)) {
        return std::numeric_limits<double>::infinity();
    }
    double widest = 0.0;
    const std::vector<Scatter> all_points = scatters();
    for (std::size_t point = 0; point < points_.size(); ++point) {
        widest = inside(point) ? widest : std::max(widest, all_points[point].error());
    }
    return student_quantile(1.0 - outside, degrees) * widest / mean;
}

}  // namespace raybundle
