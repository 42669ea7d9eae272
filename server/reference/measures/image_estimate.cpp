// SPDX-License-Identifier: Apache-2.0
#include "reference/measures/image_estimate.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

namespace raybundle {
namespace {

constexpr std::size_t pixels_per_task = 64;

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

ImageEstimate::ImageEstimate(glm::uvec2 size, std::uint64_t seed, PixelFilter filter)
    : size_(size),
      seed_(seed),
      filter_(filter),
      sums_(std::size_t{size.x} * size.y * batches, glm::dvec3(0.0)) {}

ImageEstimate::ImageEstimate(std::span<const std::uint32_t> pixels, std::uint64_t seed,
                             PixelFilter filter)
    : size_(pixels.size(), 1),
      pixels_(pixels.begin(), pixels.end()),
      seed_(seed),
      filter_(filter),
      sums_(pixels_.size() * batches, glm::dvec3(0.0)) {}

void ImageEstimate::add_pass(const CameraRays& camera, const RadianceEstimator& estimator) {
    const std::size_t pixels = sums_.size() / batches;
    std::atomic<std::uint64_t> dropped{0};
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, pixels, pixels_per_task),
        [&](const tbb::blocked_range<std::size_t>& range) {
            for (std::size_t pixel = range.begin(); pixel < range.end(); ++pixel) {
                PixelRay ray = next_ray(pixel, camera);
                if (!add(pixel, estimator(camera.origin(), ray.direction, ray.sampler))) {
                    ++dropped;
                }
            }
        });
    ++passes_;
    non_finite_ += dropped;
}

void ImageEstimate::add_splatting_pass(const CameraRays& camera,
                                       const SplattingEstimator& estimator) {
    const std::size_t pixels = sums_.size() / batches;
    const std::size_t tasks = (pixels + pixels_per_task - 1) / pixels_per_task;
    std::vector<std::vector<Splat>> splats(tasks);
    tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
        const std::size_t last = std::min((task + 1) * pixels_per_task, pixels);
        for (std::size_t pixel = task * pixels_per_task; pixel < last; ++pixel) {
            PixelRay ray = next_ray(pixel, camera);
            const glm::dvec3 value =
                estimator(camera.origin(), ray.direction, ray.sampler, splats[task]);
            splats[task].push_back({pixel, value});
        }
    });
    for (const std::vector<Splat>& list : splats) {
        for (const Splat& splat : list) {
            non_finite_ += add(splat.pixel, splat.value) ? 0 : 1;
        }
    }
    ++passes_;
}

void ImageEstimate::add_tiled_pass(const CameraRays& camera, std::uint32_t side,
                                   const TileEstimator& estimator) {
    const glm::uvec2 tiles = (size_ + side - 1U) / side;
    std::atomic<std::uint64_t> dropped{0};
    tbb::parallel_for(0U, tiles.x * tiles.y, [&](std::uint32_t tile) {
        const glm::uvec2 first = side * glm::uvec2(tile % tiles.x, tile / tiles.x);
        const glm::uvec2 end = glm::min(first + side, size_);
        std::vector<std::size_t> pixels;
        std::vector<PixelRay> rays;
        for (std::uint32_t y = first.y; y < end.y; ++y) {
            for (std::uint32_t x = first.x; x < end.x; ++x) {
                pixels.push_back(std::size_t{y} * size_.x + x);
                rays.push_back(next_ray(pixels.back(), camera));
            }
        }
        std::vector<glm::dvec3> radiance(rays.size(), glm::dvec3(0.0));
        estimator(camera.origin(), rays, radiance);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            if (!add(pixels[i], radiance[i])) {
                ++dropped;
            }
        }
    });
    ++passes_;
    non_finite_ += dropped;
}

PixelRay ImageEstimate::next_ray(std::size_t pixel, const CameraRays& camera) const {
    const auto batch = static_cast<std::uint32_t>(passes_ % batches);
    const auto shown = pixels_.empty() ? static_cast<std::uint32_t>(pixel) : pixels_[pixel];
    PixelSampler sampler(seed_, shown, batch, static_cast<std::uint32_t>(passes_ / batches));
    const glm::dvec2 within = filter_ == PixelFilter::box ? sampler.next_pair() : glm::dvec2(0.5);
    return {camera.direction(camera.corner(shown) + within), sampler};
}

bool ImageEstimate::add(std::size_t pixel, const glm::dvec3& value) {
    const bool finite = is_finite(value);
    if (finite) {
        sums_[pixel * batches + passes_ % batches] += value;
    }
    return finite;
}

glm::dvec3 ImageEstimate::mean(std::size_t pixel) const {
    glm::dvec3 sum(0.0);
    for (std::size_t batch = 0; batch < batches; ++batch) {
        sum += sums_[pixel * batches + batch];
    }
    return sum / static_cast<double>(std::max<std::uint64_t>(passes_, 1));
}

glm::dvec3 ImageEstimate::batch_mean(std::size_t pixel, std::uint32_t batch) const {
    return sums_[pixel * batches + batch] /
           static_cast<double>(std::max<std::uint64_t>(samples_of(batch), 1));
}

glm::dvec3 ImageEstimate::standard_error(std::size_t pixel) const {
    if (passes_ < batches) {
        return glm::dvec3(std::numeric_limits<double>::infinity());
    }
    // Batch means scatter about the mean with sigma^2 / n_b; n_b differ by at most one.
    const glm::dvec3 centre = mean(pixel);
    glm::dvec3 scatter(0.0);
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
        const auto count = static_cast<double>(samples_of(batch));
        const glm::dvec3 deviation = batch_mean(pixel, batch) - centre;
        scatter += count * deviation * deviation;
    }
    return glm::sqrt(scatter / static_cast<double>((batches - 1) * passes_));
}

std::vector<glm::dvec3> ImageEstimate::means() const {
    std::vector<glm::dvec3> result(sums_.size() / batches);
    for (std::size_t pixel = 0; pixel < result.size(); ++pixel) {
        result[pixel] = mean(pixel);
    }
    return result;
}

/// Of the pixels [first, last).
BatchScatter ImageEstimate::scatter(std::size_t first, std::size_t last,
                                    const std::vector<bool>& measured) const {
    BatchScatter sum(batches);
    std::array<glm::dvec3, batches> deviations;
    for (std::size_t pixel = first; pixel < last; ++pixel) {
        if (!measured.empty() && !measured[pixel]) {
            continue;
        }
        const glm::dvec3 centre = mean(pixel);
        for (std::uint32_t batch = 0; batch < batches; ++batch) {
            const double share =
                static_cast<double>(samples_of(batch)) / static_cast<double>(passes_);
            deviations[batch] = std::sqrt(share) * (batch_mean(pixel, batch) - centre);
        }
        sum.add(deviations, centre);
    }
    return sum;
}

ImageError ImageEstimate::error(const std::vector<bool>& measured) const {
    if (passes_ < batches) {
        return {};
    }
    const std::size_t pixels = sums_.size() / batches;
    constexpr std::size_t a_task = 4096;
    std::vector<BatchScatter> parts((pixels + a_task - 1) / a_task, BatchScatter(batches));
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
        parts[i] = scatter(i * a_task, std::min((i + 1) * a_task, pixels), measured);
    });
    BatchScatter sum(batches);
    for (const BatchScatter& part : parts) {
        sum.add(part);
    }
    return sum.error();
}

}  // namespace raybundle
