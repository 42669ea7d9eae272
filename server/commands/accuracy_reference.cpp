// SPDX-License-Identifier: Apache-2.0
#include "commands/accuracy_reference.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>

#include "research/accuracy/error_curve.h"

namespace raybundle {
namespace {

/// The error of path tracing with scrambled (0, 2)-sequences falls about like samples^-0.65; this
/// only foretells when to look again, and the time left.
constexpr double foreseen_rate = 0.65;
constexpr double safety = 0.98;  // the noise is itself an estimate
constexpr std::uint64_t least_passes = 2 * ImageEstimate::batches;

class Refinement {
  public:
    Refinement(const ReferenceJob& job, Progress& progress)
        : job_(job),
          progress_(progress),
          maker_(job.scene, job.lights, job.camera, job.measured, job.key.filter, job.seed,
                 load_cached_reference(job.file, job.key)) {}

    ReferencePicture run() {
        if (!std::isfinite(maker_.noise())) {
            add_passes(least_passes);
        }
        while (true) {
            const ReferencePicture now = maker_.result();
            const double best = job_.best_error(now);
            const double noise = now.noise->relative_rmse;
            if (noise * reference_margin <= best || !has_time()) {
                return finished(now, best);
            }
            goal_ = best > 0.0 ? safety * best / reference_margin : 0.5 * noise;
            // What a noisy reference says of the best picture may be far too little.
            refine_to(std::max(goal_, 0.5 * noise));
        }
    }

  private:
    [[nodiscard]] bool has_time() const { return clock_.seconds() < job_.seconds; }

    void add_passes(std::uint64_t count) {
        for (std::uint64_t i = 0; i < count && (has_time() || passes_ < least_passes); ++i) {
            maker_.add_pass();
            ++passes_;
            report();
        }
    }

    /// Whole rounds of the batches; the noise is looked at when it should be low enough, and
    /// whenever there is an eighth more.
    void refine_to(double target) {
        while (has_time() && maker_.noise() > target) {
            const double wanted = samples_until(target);
            const double more = std::min(wanted, static_cast<double>(passes_) / 8.0);
            const auto rounds = static_cast<std::uint64_t>(more / ImageEstimate::batches);
            add_passes(std::max<std::uint64_t>(rounds, 1) * ImageEstimate::batches);
            noise_ = maker_.noise();
        }
    }

    /// More samples, foreseen, until the noise is so low.
    [[nodiscard]] double samples_until(double target) const {
        return static_cast<double>(maker_.samples()) *
               (std::pow(maker_.noise() / target, 1.0 / foreseen_rate) - 1.0);
    }

    void report() {
        const double spent = clock_.seconds();
        double left = job_.seconds - spent;
        if (noise_ > 0.0 && goal_ > 0.0) {
            left = std::min(left, spent * (std::pow(noise_ / goal_, 1.0 / foreseen_rate) - 1.0));
        }
        progress_.show(spent / std::max(spent + left, 1e-9), left,
                       fmt::format("{} samples, noise {:.2f} %", passes_, 100.0 * noise_));
    }

    ReferencePicture finished(const ReferencePicture& reference, double best) const {
        const double noise = reference.noise->relative_rmse;
        if (passes_ > 0) {
            save_reference(job_.file, job_.key, reference);
        }
        spdlog::info("{}: {} samples a pixel, noise {:.3f} %, best picture {:.3f} % off", job_.file,
                     reference.samples, 100.0 * noise, 100.0 * best);
        if (noise * reference_margin > best) {
            spdlog::warn(
                "{}: after {:.0f} s the reference is less than {} times as accurate as the best "
                "picture; what it does not resolve has open markers. Run again to refine it "
                "further.",
                job_.file, clock_.seconds(), reference_margin);
        }
        return reference;
    }

    const ReferenceJob& job_;
    Progress& progress_;
    ReferenceMaker maker_;
    Stopwatch clock_;
    std::uint64_t passes_ = 0;
    double noise_ = 0.0;
    double goal_ = 0.0;  // noise as it is wanted in the end
};

}  // namespace

ReferencePicture make_reference(const ReferenceJob& job, Progress& progress) {
    progress.begin("reference by path tracing, pixel " + filter_name(job.key.filter));
    return Refinement(job, progress).run();
}

}  // namespace raybundle
