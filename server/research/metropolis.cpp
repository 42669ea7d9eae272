// SPDX-License-Identifier: Apache-2.0
#include "research/metropolis.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "reference/sampling/discrete_distribution.h"

namespace raybundle {
namespace {

/// Streams of random numbers: of candidates, and of what chains do. Each kind has its own range.
constexpr std::uint64_t candidate_streams = 0;
constexpr std::uint64_t mutation_streams = std::uint64_t{1} << 40U;
constexpr std::uint64_t decision_streams = std::uint64_t{2} << 40U;

std::size_t pixel_count(const CameraRays& camera) {
    return std::size_t{camera.size().x} * camera.size().y;
}

}  // namespace

Metropolis::Metropolis(const PathTracer& tracer, const CameraRays& camera, std::uint64_t seed)
    : tracer_(tracer),
      camera_(camera),
      seed_(seed),
      steps_per_chain_(static_cast<std::uint32_t>(
          (pixel_count(camera) + batches * chains_per_batch - 1) / (batches * chains_per_batch))) {
    begin();
}

Metropolis::Contribution Metropolis::contribution(PrimarySample& sample) const {
    const glm::uvec2 size = camera_.size();
    const glm::dvec2 at = sample.next_pair() * glm::dvec2(size);
    const std::size_t column = std::min(static_cast<std::size_t>(at.x), std::size_t{size.x} - 1);
    const std::size_t row = std::min(static_cast<std::size_t>(at.y), std::size_t{size.y} - 1);
    Contribution result;
    result.pixel = row * size.x + column;
    const glm::dvec3 radiance = tracer_.radiance(camera_.origin(), camera_.direction(at), sample);
    result.finite =
        std::isfinite(radiance.r) && std::isfinite(radiance.g) && std::isfinite(radiance.b);
    if (result.finite) {
        result.radiance = radiance;
        result.luminance = luminance(glm::vec3(radiance));
    }
    return result;
}

PrimarySample Metropolis::candidate(std::uint32_t batch, std::uint32_t index) const {
    return PrimarySample(RandomStream(
        seed_, candidate_streams + std::uint64_t{batch} * candidates_per_batch + index));
}

void Metropolis::begin() {
    std::vector<double> luminances(std::size_t{batches} * candidates_per_batch);
    tbb::parallel_for(std::size_t{0}, luminances.size(), [&](std::size_t i) {
        PrimarySample sample = candidate(static_cast<std::uint32_t>(i / candidates_per_batch),
                                         static_cast<std::uint32_t>(i % candidates_per_batch));
        luminances[i] = contribution(sample).luminance;
    });
    for (std::uint32_t batch = 0; batch < batches; ++batch) {
        const auto first = luminances.begin() + std::ptrdiff_t{batch} * candidates_per_batch;
        begin_batch(batch, {first, first + candidates_per_batch});
    }
}

void Metropolis::begin_batch(std::uint32_t index, const std::vector<double>& luminances) {
    Batch& batch = batches_[index];
    batch.sums.assign(pixel_count(camera_), glm::dvec3(0.0));
    batch.uniform_points = candidates_per_batch;
    for (const double value : luminances) {
        batch.luminance_sum += value;
    }
    const DiscreteDistribution choice(luminances);
    if (choice.empty()) {
        return;  // no candidate has found light
    }
    for (std::uint32_t i = 0; i < chains_per_batch; ++i) {
        const std::uint64_t number = std::uint64_t{index} * chains_per_batch + i;
        RandomStream decisions(seed_, decision_streams + number);
        PrimarySample sample =
            candidate(index, static_cast<std::uint32_t>(choice.sample(decisions.next())));
        const Contribution start = contribution(sample);
        sample.continue_with(RandomStream(seed_, mutation_streams + number));
        batch.chains.push_back({sample, decisions, start, {}, 0.0, 0, 0});
    }
}

void Metropolis::iterate() {
    tbb::parallel_for(std::uint32_t{0}, batches * chains_per_batch, [this](std::uint32_t i) {
        Batch& batch = batches_[i / chains_per_batch];
        if (!batch.chains.empty()) {
            advance(batch.chains[i % chains_per_batch]);
        }
    });
    for (Batch& batch : batches_) {
        collect(batch);
    }
    ++iterations_;
}

void Metropolis::advance(Chain& chain) const {
    for (std::uint32_t step = 0; step < steps_per_chain_; ++step) {
        const bool large = chain.decisions.next() < large_step_share;
        chain.sample.propose(large);
        const Contribution proposed = contribution(chain.sample);
        chain.dropped += proposed.finite ? 0 : 1;
        if (large) {
            chain.luminance_sum += proposed.luminance;
            ++chain.large_steps;
        }
        const double acceptance = std::min(proposed.luminance / chain.current.luminance, 1.0);
        if (acceptance > 0.0) {
            chain.splats.push_back(
                {proposed.pixel, acceptance / proposed.luminance * proposed.radiance});
        }
        chain.splats.push_back({chain.current.pixel, (1.0 - acceptance) / chain.current.luminance *
                                                         chain.current.radiance});
        if (chain.decisions.next() < acceptance) {
            chain.current = proposed;
            chain.sample.accept();
        } else {
            chain.sample.reject();
        }
    }
}

void Metropolis::collect(Batch& batch) {
    for (Chain& chain : batch.chains) {
        for (const Splat& splat : chain.splats) {
            batch.sums[splat.pixel] += splat.value;
        }
        chain.splats.clear();
        batch.luminance_sum += chain.luminance_sum;
        batch.uniform_points += chain.large_steps;
        batch.steps += steps_per_chain_;
        non_finite_ += chain.dropped;
        chain.luminance_sum = 0.0;
        chain.large_steps = 0;
        chain.dropped = 0;
    }
}

glm::dvec3 Metropolis::batch_mean(const Batch& batch, std::size_t pixel) const {
    if (batch.steps == 0) {
        return glm::dvec3(0.0);
    }
    const double mean_luminance = batch.luminance_sum / static_cast<double>(batch.uniform_points);
    return batch.sums[pixel] * (mean_luminance * static_cast<double>(batch.sums.size()) /
                                static_cast<double>(batch.steps));
}

std::vector<glm::dvec3> Metropolis::picture() const {
    std::vector<glm::dvec3> result(pixel_count(camera_), glm::dvec3(0.0));
    for (std::size_t pixel = 0; pixel < result.size(); ++pixel) {
        for (const Batch& batch : batches_) {
            result[pixel] += batch_mean(batch, pixel) / double{batches};
        }
    }
    return result;
}

ImageError Metropolis::error(const std::vector<bool>& measured) const {
    const std::vector<glm::dvec3> means = picture();
    BatchScatter scatter(batches);
    std::array<glm::dvec3, batches> deviations;
    for (std::size_t pixel = 0; pixel < means.size(); ++pixel) {
        if (measured[pixel]) {
            std::transform(
                batches_.begin(), batches_.end(), deviations.begin(), [&](const Batch& batch) {
                    return (batch_mean(batch, pixel) - means[pixel]) * std::sqrt(1.0 / batches);
                });
            scatter.add(deviations, means[pixel]);
        }
    }
    return scatter.error();
}

std::size_t Metropolis::bytes() const {
    return batches * pixel_count(camera_) * sizeof(glm::dvec3);
}

}  // namespace raybundle
