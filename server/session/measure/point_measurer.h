// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "measure/make_measurement.h"
#include "measure/zone_luminaires.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "scheduling/scheduling_settings.h"

namespace raybundle {

/// Gathers light at the calculation points of measurements, on a thread of its own, which pauses so
/// that it takes a small share of one core once all have values, and sleeps once all are as exact
/// as they are to be. After a change of the scene all begin anew. Its methods are for one thread;
/// only set_scene() takes long, for a copy.
class PointMeasurer {
  public:
    struct Task {
        std::vector<CalculationPoint> points;
        MeasurementSettings settings;
        double relative_error = 0.05;  ///< to reach
        bool maintained = false;       ///< by the lamps' own maintenance factors
        bool luminaires = false;       ///< find those that light the points, too
    };
    struct Result {
        std::uint32_t measurement = 0;
        std::uint32_t epoch = 0;
        double relative_error = 0.0;
        std::vector<Interval> values;           ///< of the points
        std::vector<bool> inside;               ///< likewise
        std::vector<GlareRating> glare;         ///< likewise, where that is measured
        std::optional<MeasurementSummary> all;  ///< nothing: all points lie in solids
        bool met = false;                       ///< the error wanted, or nothing is to be measured
        std::vector<ZoneLuminaire> luminaires{};  ///< where they are asked for
    };

    explicit PointMeasurer(const RestSettings& rests);
    ~PointMeasurer();
    PointMeasurer(const PointMeasurer&) = delete;
    PointMeasurer& operator=(const PointMeasurer&) = delete;

    /// Whether it has this state of the scene.
    [[nodiscard]] bool has_scene(std::uint32_t epoch) const { return scene_ && epoch_ == epoch; }
    /// Whether it would take another one at once: it does not prepare one.
    [[nodiscard]] bool takes_scene();
    void set_scene(std::uint32_t epoch, const Scene& scene, const PatchMesh& mesh);
    void add(std::uint32_t measurement, Task task);
    void remove(std::uint32_t measurement);
    /// What is new since the last call: the first values of a measurement in a scene, values whose
    /// error is a third less, and the last ones.
    [[nodiscard]] std::vector<Result> take();

  private:
    struct OwnScene;
    struct Job {
        std::shared_ptr<const Task> task;
        std::unique_ptr<Measurement> points;    // of the thread alone
        std::vector<ZoneLuminaire> luminaires;  // in the scene of the points
        std::shared_ptr<const OwnScene> scene;  // that the points are in
        std::uint32_t epoch = 0;
        double reported = 0.0;  // error of the last result
        bool done = false;
    };

    void run();
    [[nodiscard]] Job* next_job();
    void work(std::unique_lock<std::mutex>& lock, std::uint32_t measurement, Job& job);
    void report(std::uint32_t measurement, Job& job, const Measurement& points);

    const RestSettings rests_;
    std::shared_ptr<const OwnScene> scene_;
    std::uint32_t epoch_ = 0;

    std::mutex mutex_;
    std::condition_variable wake_;
    bool stop_ = false;
    bool preparing_ = false;
    std::shared_ptr<const OwnScene> newest_;  // scene_ as the thread may take it
    std::uint32_t newest_epoch_ = 0;
    std::map<std::uint32_t, Job> jobs_;
    std::uint32_t working_ = 0;  // measurement whose points the thread has in its hands
    std::vector<Result> results_;
    std::thread thread_;
};

}  // namespace raybundle
