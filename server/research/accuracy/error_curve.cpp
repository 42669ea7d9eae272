// SPDX-License-Identifier: Apache-2.0
#include "research/accuracy/error_curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace raybundle {
namespace {

constexpr double first_checkpoint = 0.1;  // s
constexpr int most_checkpoints = 19;

/// 97.5 % quantiles of Student's t for 1 to 15 degrees of freedom.
constexpr std::array<double, 15> student_t = {12.706, 4.303, 3.182, 2.776, 2.571,
                                              2.447,  2.365, 2.306, 2.262, 2.228,
                                              2.201,  2.179, 2.160, 2.145, 2.131};

double without_noise(double measured, double noise) {
    return std::sqrt(std::max(measured * measured - noise * noise, 0.0));
}

const CurvePoint* point_at(const ErrorCurve& run, unsigned checkpoint) {
    const auto found = std::find_if(run.points.begin(), run.points.end(), [&](const CurvePoint& p) {
        return p.checkpoint == checkpoint;
    });
    return found == run.points.end() ? nullptr : &*found;
}

/// The same checkpoint of all runs; empty where one lacks it.
std::vector<CurvePoint> points_at(const std::vector<ErrorCurve>& runs, unsigned checkpoint) {
    std::vector<CurvePoint> result;
    for (const ErrorCurve& run : runs) {
        const CurvePoint* point = point_at(run, checkpoint);
        if (point == nullptr) {
            return {};
        }
        result.push_back(*point);
    }
    return result;
}

double mean_of(const std::vector<CurvePoint>& points, double CurvePoint::*member) {
    double sum = 0.0;
    for (const CurvePoint& point : points) {
        sum += point.*member;
    }
    return sum / static_cast<double>(points.size());
}

double mean_square_root_of(const std::vector<CurvePoint>& points, double CurvePoint::*member) {
    double sum = 0.0;
    for (const CurvePoint& point : points) {
        sum += point.*member * (point.*member);
    }
    return std::sqrt(sum / static_cast<double>(points.size()));
}

/// Of the geometric mean, by Student's t over the logarithms.
std::optional<std::pair<double, double>> interval_of(const std::vector<CurvePoint>& points) {
    const bool positive = std::all_of(points.begin(), points.end(),
                                      [](const CurvePoint& p) { return p.relative_rmse > 0.0; });
    if (points.size() < 2 || !positive) {
        return std::nullopt;
    }
    const auto count = static_cast<double>(points.size());
    double mean = 0.0;
    for (const CurvePoint& point : points) {
        mean += std::log(point.relative_rmse) / count;
    }
    double squares = 0.0;
    for (const CurvePoint& point : points) {
        squares += std::pow(std::log(point.relative_rmse) - mean, 2);
    }
    const double half_width =
        student_t[points.size() - 2] * std::sqrt(squares / (count - 1.0) / count);
    return std::pair{std::exp(mean - half_width), std::exp(mean + half_width)};
}

CurvePoint merged(const std::vector<CurvePoint>& points) {
    CurvePoint result = points.front();
    result.seconds = mean_of(points, &CurvePoint::seconds);
    double iterations = 0.0;
    for (const CurvePoint& point : points) {
        iterations += static_cast<double>(point.iterations);
        result.resolved = result.resolved && point.resolved;
    }
    result.iterations =
        static_cast<std::uint64_t>(std::llround(iterations / static_cast<double>(points.size())));
    result.relative_rmse = mean_square_root_of(points, &CurvePoint::relative_rmse);
    result.estimated_error = mean_square_root_of(points, &CurvePoint::estimated_error);
    for (const auto member : {&CurvePoint::mrse, &CurvePoint::median, &CurvePoint::p95,
                              &CurvePoint::estimated_low, &CurvePoint::estimated_high}) {
        result.*member = mean_of(points, member);
    }
    result.interval = interval_of(points);
    return result;
}

/// Where the line between two points meets an error, on logarithmic scales. Requires a's error
/// above it and b's not.
double crossing(const CurvePoint& a, const CurvePoint& b, double error) {
    if (!(b.relative_rmse > 0.0) || !(a.seconds > 0.0)) {
        return b.seconds;
    }
    const double share =
        std::log(a.relative_rmse / error) / std::log(a.relative_rmse / b.relative_rmse);
    return a.seconds * std::pow(b.seconds / a.seconds, share);
}

}  // namespace

std::vector<double> checkpoint_times(double seconds) {
    std::vector<double> times = {seconds};
    for (int i = 1; i < most_checkpoints; ++i) {
        const double time = seconds * std::pow(2.0, -0.5 * i);
        if (time < first_checkpoint) {
            break;
        }
        times.push_back(time);
    }
    std::reverse(times.begin(), times.end());
    return times;
}

void set_measured(CurvePoint& point, const ImageMetrics& measured, const ReferenceNoise& noise) {
    point.relative_rmse = without_noise(measured.relative_rmse, noise.relative_rmse);
    point.mrse = std::max(measured.mrse - noise.mrse, 0.0);
    point.median = measured.median;
    point.p95 = measured.p95;
    point.resolved =
        point.relative_rmse > 0.0 && point.relative_rmse >= reference_margin * noise.relative_rmse;
}

ErrorCurve merged_runs(const std::vector<ErrorCurve>& runs) {
    if (runs.empty() || runs.size() > student_t.size() + 1) {
        throw std::invalid_argument("1 to 16 runs make a curve");
    }
    ErrorCurve result = runs.front();
    if (runs.size() == 1) {
        return result;
    }
    result.points.clear();
    for (const CurvePoint& point : runs.front().points) {
        const std::vector<CurvePoint> points = points_at(runs, point.checkpoint);
        if (!points.empty()) {
            result.points.push_back(merged(points));
        }
    }
    return result;
}

std::optional<TimeToError> time_to_error(const ErrorCurve& curve, double relative_rmse) {
    const std::vector<CurvePoint>& points = curve.points;
    const auto last_above = std::find_if(
        points.rbegin(), points.rend(),
        [&](const CurvePoint& point) { return !(point.relative_rmse <= relative_rmse); });
    if (points.empty() || last_above == points.rbegin()) {
        return std::nullopt;
    }
    if (last_above == points.rend()) {
        return TimeToError{points.front().seconds, true, points.front().resolved};
    }
    const CurvePoint& after = *(last_above - 1);
    return TimeToError{crossing(*last_above, after, relative_rmse), false,
                       last_above->resolved && after.resolved};
}

}  // namespace raybundle
