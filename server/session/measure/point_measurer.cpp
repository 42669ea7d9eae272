// SPDX-License-Identifier: Apache-2.0
#include "session/measure/point_measurer.h"

#include <spdlog/spdlog.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <utility>

#include "measure/daylight_scene.h"
#include "session/measure/thread_time.h"

namespace raybundle {
namespace {

/// Points that get 16 paths each between two looks at what else there is to do: some milliseconds.
constexpr std::size_t slice = 32;

/// What shines in a scene that is measured.
enum class SceneLight : std::size_t { present, maintained, overcast };

SceneLight light_of(const PointMeasurer::Task& task) {
    return task.settings.quantity == Quantity::daylight_factor ? SceneLight::overcast
           : task.maintained                                   ? SceneLight::maintained
                                                               : SceneLight::present;
}

/// A scene of its own with what points need of it.
struct OwnMeasuredScene {
    OwnMeasuredScene(Scene s, PatchMesh m, SceneLight light)
        : scene(std::move(s)), mesh(std::move(m)) {
        if (light == SceneLight::overcast) {
            leave_overcast_sky(scene, mesh);
        } else if (light == SceneLight::maintained) {
            maintain_lamps(scene, mesh);
        }
        measured = std::make_unique<const MeasuredScene>(scene, mesh);
    }

    Scene scene;
    PatchMesh mesh;
    std::unique_ptr<const MeasuredScene> measured;
};

}  // namespace

/// A copy, since the present scene goes on to change; prepared when the first measurement needs it,
/// on the thread.
struct PointMeasurer::OwnScene {
    OwnScene(const Scene& s, const PatchMesh& m) : scene(s), mesh(m) {}

    [[nodiscard]] std::shared_ptr<const MeasuredScene> measured(SceneLight light) const {
        std::shared_ptr<const OwnMeasuredScene>& own = own_[static_cast<std::size_t>(light)];
        if (!own) {
            own = std::make_shared<const OwnMeasuredScene>(scene, mesh, light);
        }
        return {own, own->measured.get()};
    }

    Scene scene;
    PatchMesh mesh;

  private:
    mutable std::array<std::shared_ptr<const OwnMeasuredScene>, 3> own_;
};

PointMeasurer::PointMeasurer(const RestSettings& rests)
    : rests_(rests), thread_([this] { run(); }) {}

PointMeasurer::~PointMeasurer() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

bool PointMeasurer::takes_scene() {
    const std::lock_guard lock(mutex_);
    return !preparing_;
}

void PointMeasurer::set_scene(std::uint32_t epoch, const Scene& scene, const PatchMesh& mesh) {
    scene_ = std::make_shared<const OwnScene>(scene, mesh);
    epoch_ = epoch;
    {
        const std::lock_guard lock(mutex_);
        newest_ = scene_;
        newest_epoch_ = epoch;
        for (auto& [id, job] : jobs_) {
            job.done = false;
        }
    }
    wake_.notify_one();
}

void PointMeasurer::add(std::uint32_t measurement, Task task) {
    {
        const std::lock_guard lock(mutex_);
        jobs_[measurement].task = std::make_shared<const Task>(std::move(task));
    }
    wake_.notify_one();
}

void PointMeasurer::remove(std::uint32_t measurement) {
    const std::lock_guard lock(mutex_);
    jobs_.erase(measurement);
    std::erase_if(results_, [&](const Result& r) { return r.measurement == measurement; });
}

std::vector<PointMeasurer::Result> PointMeasurer::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(results_, {});
}

/// The one with fewest samples.
PointMeasurer::Job* PointMeasurer::next_job() {
    Job* next = nullptr;
    std::uint64_t fewest = 0;
    for (auto& [id, job] : jobs_) {
        const std::uint64_t rounds = job.points && job.scene == newest_ ? job.points->rounds() : 0;
        if (!job.done && (next == nullptr || rounds < fewest)) {
            next = &job;
            fewest = rounds;
            working_ = id;
        }
    }
    return next;
}

void PointMeasurer::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        Job* job = nullptr;
        wake_.wait(lock, [&] { return stop_ || (newest_ && (job = next_job()) != nullptr); });
        if (stop_) {
            return;
        }
        const std::chrono::nanoseconds start = thread_time();
        const bool first = job->reported == 0.0 || job->scene != newest_;
        try {
            work(lock, working_, *job);
        } catch (const std::exception& error) {  // as where there is no memory for it
            spdlog::warn("points could not be measured: {}", error.what());
            if (!lock.owns_lock()) {
                lock.lock();
            }
            preparing_ = false;
            jobs_.erase(working_);
        }
        const double rest = first ? rests_.first_points : rests_.points;
        wake_.wait_for(lock, rest * (thread_time() - start), [this] { return stop_; });
    }
}

/// With the lock released while it works; the job may be gone afterwards.
void PointMeasurer::work(std::unique_lock<std::mutex>& lock, std::uint32_t measurement, Job& job) {
    const std::shared_ptr<const Task> task = job.task;
    const std::shared_ptr<const OwnScene> scene = newest_;
    const std::uint32_t epoch = newest_epoch_;
    const bool anew = !job.points || job.scene != scene;
    std::unique_ptr<Measurement> points = anew ? nullptr : std::move(job.points);
    std::vector<ZoneLuminaire> luminaires;
    preparing_ = anew;
    lock.unlock();
    tbb::task_arena arena(1);
    arena.execute([&] {
        if (anew) {
            const auto measured = scene->measured(light_of(*task));
            points = make_measurement(measured, task->points, task->settings);
            if (task->luminaires) {
                luminaires = find_zone_luminaires(*measured, task->points, task->settings.quantity,
                                                  task->settings.direct);
            }
        }
        points->add_samples(slice);
    });
    lock.lock();
    preparing_ = false;
    const auto found = jobs_.find(measurement);
    if (found == jobs_.end() || found->second.task != task) {
        return;
    }
    Job& same = found->second;
    same.points = std::move(points);
    if (anew) {
        same.scene = scene;
        same.epoch = epoch;
        same.luminaires = std::move(luminaires);
        same.reported = 0.0;
    }
    report(measurement, same, *same.points);
}

void PointMeasurer::report(std::uint32_t measurement, Job& job, const Measurement& points) {
    constexpr double worth_telling = 2.0 / 3.0;  // of the error told last
    const bool nothing = points.measured() == 0;
    if (!nothing && points.rounds() < PointMeasurement::least_rounds) {
        return;
    }
    const double error = points.relative_error();
    // Where no light arrives no error is relative: it is as dark after so many paths.
    constexpr std::uint64_t enough_for_darkness = 64;
    const bool dark = !(error < 1e9) && points.rounds() >= enough_for_darkness;
    const bool met = nothing || dark || error <= job.task->relative_error;
    if (!met && job.reported > 0.0 && !(error < worth_telling * job.reported)) {
        return;
    }
    Result result;
    result.measurement = measurement;
    result.epoch = job.epoch;
    result.relative_error = error;
    result.values = points.values();
    for (std::size_t i = 0; i < points.points().size(); ++i) {
        result.inside.push_back(points.inside(i));
    }
    result.glare = points.glare();
    result.all = points.all();
    result.met = met;
    result.luminaires = job.luminaires;
    job.reported = error;
    job.done = met && job.scene == newest_;
    std::erase_if(results_, [&](const Result& r) { return r.measurement == measurement; });
    results_.push_back(std::move(result));
}

}  // namespace raybundle
