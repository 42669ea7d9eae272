// SPDX-License-Identifier: Apache-2.0
#include "research/accuracy/reference_picture.h"

#include <chrono>
#include <limits>

namespace raybundle {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* own_method = "path-reuse";
constexpr double mrse_floor = 0.01;  // of the mean, as in compare_images()

double squared(double value) {
    return value * value;
}

}  // namespace

std::string filter_name(PixelFilter filter) {
    return filter == PixelFilter::centre ? "centre" : "area";
}

ReferenceMaker::ReferenceMaker(const RayScene& scene, const LightSampling& lights,
                               const CameraRays& camera, const std::vector<bool>& measured,
                               PixelFilter filter, std::uint64_t seed,
                               std::optional<ReferencePicture> earlier)
    : paths_(scene, lights),
      camera_(camera),
      measured_(measured),
      // Samples on top of earlier ones must not repeat them.
      seed_(mixed_bits(earlier ? earlier->seed : seed)),
      earlier_(std::move(earlier)),
      image_(camera.size(), seed_, filter),
      filter_(filter) {}

void ReferenceMaker::add_pass() {
    const Clock::time_point start = Clock::now();
    paths_.add_pass(image_, camera_);
    seconds_ += std::chrono::duration<double>(Clock::now() - start).count();
}

ReferenceNoise ReferenceMaker::own_noise() const {
    double variances = 0.0;
    double squares = 0.0;
    glm::dvec3 sum(0.0);
    std::size_t count = 0;
    for (std::size_t i = 0; i < measured_.size(); ++i) {
        if (measured_[i]) {
            const glm::dvec3 mean = image_.mean(i);
            const glm::dvec3 error = image_.standard_error(i);
            variances += glm::dot(error, error);
            squares += glm::dot(mean, mean);
            sum += mean;
            ++count;
        }
    }
    if (count == 0 || !(squares > 0.0)) {
        return {};
    }
    const double pixels = static_cast<double>(count);
    const double mean = (sum.r + sum.g + sum.b) / (3.0 * pixels);
    double ratios = 0.0;
    for (std::size_t i = 0; i < measured_.size(); ++i) {
        if (measured_[i]) {
            const glm::dvec3 ratio =
                image_.standard_error(i) / (image_.mean(i) + mrse_floor * mean);
            ratios += glm::dot(ratio, ratio);
        }
    }
    return {std::sqrt(variances / squares), ratios / (3.0 * pixels)};
}

double ReferenceMaker::earlier_weight(const ReferenceNoise& own) const {
    const double before = squared(earlier_->noise->relative_rmse);
    const double now = squared(own.relative_rmse);
    return before + now > 0.0 ? now / (before + now) : 0.5;
}

std::uint64_t ReferenceMaker::samples() const {
    return image_.passes() + (earlier_ ? earlier_->samples : 0);
}

double ReferenceMaker::noise() const {
    const bool known = image_.passes() >= ImageEstimate::batches;
    if (!known) {
        return earlier_ ? earlier_->noise->relative_rmse : std::numeric_limits<double>::infinity();
    }
    const double own = own_noise().relative_rmse;
    if (!earlier_) {
        return own;
    }
    const double before = earlier_->noise->relative_rmse;
    return before + own > 0.0 ? own * before / std::hypot(own, before) : 0.0;
}

ReferencePicture ReferenceMaker::result() const {
    if (image_.passes() < ImageEstimate::batches && earlier_) {
        return *earlier_;
    }
    ReferencePicture result{filter_,         own_method, image_.means(), own_noise(),
                            image_.passes(), seed_,      seconds_};
    if (!earlier_) {
        return result;
    }
    const std::string& before = earlier_->method;
    if (before.find(own_method) != std::string::npos) {
        result.method = before;
    } else {
        result.method = before.empty() ? "" : before + ", " + own_method;
    }
    const double w = earlier_weight(*result.noise);
    for (std::size_t i = 0; i < result.radiance.size(); ++i) {
        result.radiance[i] = w * earlier_->radiance[i] + (1.0 - w) * result.radiance[i];
    }
    result.noise = {noise(),
                    squared(w) * earlier_->noise->mrse + squared(1.0 - w) * result.noise->mrse};
    result.samples += earlier_->samples;
    result.seconds += earlier_->seconds;
    return result;
}

}  // namespace raybundle
