// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "research/accuracy/error_curve.h"
#include "research/plot/line_plot.h"

namespace raybundle {

/// A reference as the report tells of it.
struct ReferenceReport {
    PixelFilter filter = PixelFilter::centre;
    std::string method;  ///< empty: a file from elsewhere
    std::string file;
    std::optional<ReferenceNoise> noise;  ///< nothing: a file from elsewhere
    std::uint64_t samples = 0;
    double seconds = 0.0;
};

/// A method's picture at the time at which all are compared, and where it errs.
struct PictureReport {
    std::string name;
    double seconds = 0.0;
    double relative_rmse = 0.0;
    std::string png;      ///< bytes
    std::string map_png;  ///< bytes; empty for the reference itself
};

/// Everything that `raybundle accuracy` has found out.
struct AccuracyReport {
    std::string scene, camera;
    std::string device;  ///< of the ray-bundle methods
    std::string processor;
    glm::uvec2 size{0};
    std::size_t patches = 0;
    double seconds = 0.0;  ///< of each run
    std::uint64_t seed = 0;
    std::size_t repeats = 1;
    std::vector<ReferenceReport> references;
    std::vector<ErrorCurve> curves;  ///< methods first, then knobs
    std::vector<PictureReport> pictures;
    double map_scale = 0.1;
};

/// The errors whose times are in the table.
inline constexpr double target_errors[] = {0.10, 0.05, 0.02, 0.01};

/// accuracy.json, as tests/figures/README.md describes it. No number in it is not finite.
nlohmann::ordered_json accuracy_json(const AccuracyReport& report);

/// A plot and the file it goes to.
struct NamedPlot {
    std::string file;
    LinePlot plot;
};

/// Error over time and over iterations, each method's own estimate against what was measured, and
/// error over time for every knob. Points that the reference does not resolve have open
/// markers.
std::vector<NamedPlot> accuracy_plots(const AccuracyReport& report);

/// One HTML page with everything in it, nothing loaded from elsewhere.
std::string accuracy_page(const AccuracyReport& report);

}  // namespace raybundle
