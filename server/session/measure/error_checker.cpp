// SPDX-License-Identifier: Apache-2.0
#include "session/measure/error_checker.h"

#include <spdlog/spdlog.h>
#include <tbb/task_arena.h>

#include <exception>
#include <utility>

#include "session/measure/thread_time.h"
#include "view/error/measured_error.h"

namespace raybundle {

namespace {

constexpr std::chrono::milliseconds longest_work(150);  // CPU time on one picture, at a time
constexpr std::size_t max_begun = 8;
constexpr std::uint64_t seed = 0x73706f7463686563ULL;

}  // namespace

/// A copy, since the present scene goes on to change; traced when the first picture needs it.
struct ErrorChecker::OwnScene {
    OwnScene(const Scene& s, const PatchMesh& m) : scene(s), mesh(m) {}

    std::shared_ptr<const TracedScene> traced(const std::shared_ptr<const OwnScene>& self) const {
        std::call_once(once, [this] { traced_ = std::make_unique<TracedScene>(scene, mesh); });
        return {self, traced_.get()};
    }

    Scene scene;
    PatchMesh mesh;

  private:
    mutable std::once_flag once;
    mutable std::unique_ptr<const TracedScene> traced_;
};

ErrorChecker::ErrorChecker(const Clock& clock, double rest)
    : clock_(clock), rest_(rest), thread_([this] { run(); }) {}

ErrorChecker::~ErrorChecker() {
    {
        const std::lock_guard lock(mutex_);
        stop_ = true;
    }
    wake_.notify_one();
    thread_.join();
}

bool ErrorChecker::idle() {
    const std::lock_guard lock(mutex_);
    return !busy_ && clock_.now() >= rests_until_;
}

void ErrorChecker::set_scene(std::uint32_t epoch, const Scene& scene, const PatchMesh& mesh) {
    scene_ = std::make_shared<const OwnScene>(scene, mesh);
    epoch_ = epoch;
}

void ErrorChecker::check(Picture picture) {
    {
        const std::lock_guard lock(mutex_);
        busy_ = true;
        job_ = Job{std::move(picture), scene_};
    }
    wake_.notify_one();
}

std::optional<ErrorChecker::Result> ErrorChecker::take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
}

void ErrorChecker::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        wake_.wait(lock, [this] { return stop_ || job_; });
        if (stop_) {
            return;
        }
        std::optional<Job> job = std::exchange(job_, std::nullopt);
        lock.unlock();
        const std::chrono::nanoseconds start = thread_time();
        std::optional<Result> result;
        try {
            result = work(*job);
        } catch (const std::exception& error) {  // as where there is no memory for it
            begun_.clear();
            spdlog::warn("a picture's error could not be measured: {}", error.what());
        }
        job.reset();
        lock.lock();
        result_ = std::move(result);
        rests_until_ = clock_.now() + std::chrono::duration_cast<TimePoint::duration>(
                                          rest_ * (thread_time() - start));
        busy_ = false;
    }
}

ErrorChecker::Result ErrorChecker::work(const Job& job) {
    const std::chrono::nanoseconds until = thread_time() + longest_work;
    SquaredError square;
    tbb::task_arena arena(1);
    arena.execute([&] {
        SpotCheck& check = paths_for(job);
        check.look_for_sparks(job.picture.radiance);
        do {
            check.add_round();
            square = check.measure(job.picture.radiance);
        } while (square.standard_error > known_well * square.value && thread_time() < until);
    });
    return {job.picture.viewer, job.picture.shown_since, job.picture.by_samples, square};
}

/// Those that were begun, where the picture still shows the same.
SpotCheck& ErrorChecker::paths_for(const Job& job) {
    const Picture& picture = job.picture;
    const auto found = begun_.find(picture.viewer);
    if (found != begun_.end() && found->second.shown_since == picture.shown_since &&
        found->second.scene == job.scene) {
        return *found->second.check;
    }
    std::erase_if(begun_, [&](const auto& entry) { return entry.second.scene != job.scene; });
    if (begun_.size() >= max_begun) {
        begun_.clear();
    }
    Begun begun{picture.shown_since, job.scene,
                std::make_unique<SpotCheck>(job.scene->traced(job.scene), picture.camera,
                                            picture.size, seed + picture.viewer)};
    return *begun_.insert_or_assign(picture.viewer, std::move(begun)).first->second.check;
}

}  // namespace raybundle
