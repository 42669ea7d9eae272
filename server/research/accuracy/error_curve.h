// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "reference/measures/image_metrics.h"
#include "research/accuracy/reference_picture.h"

namespace raybundle {

/// Geometric in time: sqrt(2) apart up to `seconds`, the first not before 0.1 s; at most 19.
std::vector<double> checkpoint_times(double seconds);

/// How far a method's picture was from the reference at one time.
struct CurvePoint {
    unsigned checkpoint = 0;  ///< index into checkpoint_times()
    double seconds = 0.0;     ///< of solving alone
    std::uint64_t iterations = 0;
    double relative_rmse = 0.0;  ///< the reference's noise subtracted in quadrature
    double mrse = 0.0;           ///< likewise
    double median = 0.0;         ///< as measured
    double p95 = 0.0;
    double estimated_error = 0.0;  ///< what the method itself says about relative_rmse
    double estimated_low = 0.0;    ///< 95 % interval of that
    double estimated_high = 0.0;
    /// The reference is `reference_margin` times more accurate.
    bool resolved = true;
    /// 95 % interval of relative_rmse, from runs of several seeds.
    std::optional<std::pair<double, double>> interval;
};

/// Errors of one method with one choice of settings, over time.
struct ErrorCurve {
    std::string method;       ///< of --method
    std::string name;         ///< in plots: the method, or what was changed in it
    std::string knob;         ///< which setting was varied; empty: none
    bool by_bundles = false;  ///< else by a method on the CPU
    nlohmann::ordered_json settings = nlohmann::ordered_json::object();
    std::vector<CurvePoint> points;
};

/// How many times more accurate a reference is than a point that is shown.
constexpr double reference_margin = 4.0;

/// Fills in what a comparison with the reference found: noise (relative RMSE and MRSE of the
/// reference) is subtracted in quadrature, since it is independent of the picture's own error.
void set_measured(CurvePoint& point, const ImageMetrics& measured, const ReferenceNoise& noise);

/// One curve from runs that differ in their seed alone: root mean square of the relRMSE with a 95 %
/// interval of its geometric mean by Student's t, means of the rest. Checkpoints that some run
/// lacks are left out. Requires 1 to 16 runs.
ErrorCurve merged_runs(const std::vector<ErrorCurve>& runs);

/// When a method was within an error for good.
struct TimeToError {
    double seconds = 0.0;
    bool at_most = false;  ///< the first point was within it already
    bool resolved = true;  ///< so are the points that it comes from
};

/// Time from which on all points are within a relRMSE, interpolated on logarithmic scales; nothing
/// where the last point is not.
std::optional<TimeToError> time_to_error(const ErrorCurve& curve, double relative_rmse);

}  // namespace raybundle
