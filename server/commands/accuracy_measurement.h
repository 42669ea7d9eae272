// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "commands/accuracy_runs.h"
#include "commands/command.h"
#include "research/accuracy/accuracy_report.h"
#include "research/accuracy/reference_cache.h"

namespace raybundle {

/// A curve's runs, one for each seed, before they are measured.
struct CurveRuns {
    const PlannedCurve* plan = nullptr;
    std::vector<MethodRun> runs;
};

/// Runs every planned curve of a job, makes the reference that they need, and measures all. A job
/// with ray bundles needs a GL context. Options, job and scene must outlive it.
class AccuracyMeasurement {
  public:
    /// Throws UsageError, and std::runtime_error where the camera sees nothing to measure.
    AccuracyMeasurement(const Options& options, const AccuracyJob& job, const LoadedScene& loaded);

    /// Runs everything; the folder of the references exists. Throws std::runtime_error.
    void run();

    /// device: what the ray bundles ran on. Requires run().
    [[nodiscard]] AccuracyReport report(const std::string& device) const;

  private:
    void leave_out_unable();
    void run_methods();
    MethodRun run_once(const PlannedCurve& plan, std::uint64_t seed, double seconds_after);
    void make_reference();
    void take_named_reference();
    [[nodiscard]] ReferenceKey key() const;
    [[nodiscard]] std::string own_reference_file() const;
    [[nodiscard]] ImageMetrics metrics(std::size_t picture, const ReferencePicture& r) const;
    [[nodiscard]] double best_error(const ReferencePicture& reference) const;
    [[nodiscard]] ErrorCurve measured_curve(const CurveRuns& curve) const;
    [[nodiscard]] std::vector<ErrorCurve> curves() const;
    void add_pictures(AccuracyReport& report) const;

    const Options& options_;
    AccuracyJob job_;
    const LoadedScene& loaded_;
    Camera camera_;
    RayScene ray_scene_;
    LightSampling lights_;
    CameraRays rays_;
    std::vector<bool> measured_;
    PictureStore pictures_;
    Progress progress_;
    std::vector<CurveRuns> curves_;
    ReferencePicture reference_;
    std::string reference_file_;
};

}  // namespace raybundle
