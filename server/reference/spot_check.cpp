// SPDX-License-Identifier: Apache-2.0
#include "reference/spot_check.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "reference/measures/emitter_pixels.h"

namespace raybundle {
namespace {

constexpr double about_pixels = 1500.0;   // that are checked of a large picture
constexpr std::size_t most_sparks = 128;  // of one picture
constexpr std::size_t most_candidates = 8192;
constexpr std::size_t most_tests = 512;  // whether a pixel is measured: 600 rays each
constexpr std::size_t most_kept = 1024;  // sparks, of all pictures so far
constexpr int batch_count = ImageEstimate::batches;

/// What one pixel adds to the sums over all of them.
struct PixelError {
    double square = 0.0;          ///< of the difference, unbiased
    double light = 0.0;           ///< squared radiance, unbiased
    double noise_variance = 0.0;  ///< of `square`, by the paths' noise; may come out below 0
};

PixelError pixel_error(const ImageEstimate& paths, std::size_t pixel, const glm::dvec3& shown) {
    constexpr double pairs = batch_count * (batch_count - 1.0);
    glm::dvec3 sum(0.0);
    glm::dvec3 light_sum(0.0);
    double squares = 0.0;
    double light_squares = 0.0;
    for (std::uint32_t batch = 0; batch < batch_count; ++batch) {
        const glm::dvec3 estimate = paths.batch_mean(pixel, batch);
        const glm::dvec3 difference = shown - estimate;
        sum += difference;
        light_sum += estimate;
        squares += glm::dot(difference, difference);
        light_squares += glm::dot(estimate, estimate);
    }
    // Covariance of the mean of all batches, between the channels.
    const glm::dvec3 mean = sum / double{batch_count};
    glm::dmat3 covariance(0.0);
    for (std::uint32_t batch = 0; batch < batch_count; ++batch) {
        const glm::dvec3 deviation = shown - paths.batch_mean(pixel, batch) - mean;
        covariance += glm::outerProduct(deviation, deviation) / pairs;
    }
    // 4 d'Cd + 2 tr(C^2) B / (B - 1) for the true difference d; E[mean' C mean] = d'Cd + tr(C^2).
    double trace = 0.0;
    for (int c = 0; c < 3; ++c) {
        trace += glm::dot(covariance[c], covariance[c]);
    }
    const double noise = 4.0 * glm::dot(mean, covariance * mean) -
                         (4.0 - 2.0 * batch_count / (batch_count - 1.0)) * trace;
    return {(glm::dot(sum, sum) - squares) / pairs,
            (glm::dot(light_sum, light_sum) - light_squares) / pairs, noise};
}

/// How far each pixel's luminance is from the median of the 3 x 3 pixels round it, cd/m².
std::vector<float> distances_from_neighbours(std::span<const glm::vec4> picture, glm::uvec2 size) {
    std::vector<float> light(picture.size());
    std::transform(picture.begin(), picture.end(), light.begin(),
                   [](const glm::vec4& p) { return luminance(glm::vec3(p)); });
    std::vector<float> distances(picture.size());
    tbb::parallel_for(0U, size.y, [&](unsigned y) {
        for (unsigned x = 0; x < size.x; ++x) {
            std::array<float, 9> around;
            std::size_t count = 0;
            for (unsigned row = y == 0 ? 0 : y - 1; row <= std::min(y + 1, size.y - 1); ++row) {
                for (unsigned column = x == 0 ? 0 : x - 1; column <= std::min(x + 1, size.x - 1);
                     ++column) {
                    around[count++] = light[std::size_t{row} * size.x + column];
                }
            }
            const auto middle = around.begin() + static_cast<std::ptrdiff_t>(count / 2);
            std::nth_element(around.begin(), middle,
                             around.begin() + static_cast<std::ptrdiff_t>(count));
            const std::size_t i = std::size_t{y} * size.x + x;
            const float distance = std::abs(light[i] - *middle);
            distances[i] = std::isfinite(distance) ? distance : 0.0F;
        }
    });
    return distances;
}

/// Sums over the pixels of a part.
struct ErrorSums {
    double square = 0.0, light = 0.0;
    double noise = 0.0;                ///< variance of `square` by the paths' noise
    std::vector<PixelError> weighted;  ///< `square` and `light` of each pixel, times its weight

    void add(const PixelError& error, double weight) {
        square += weight * error.square;
        light += weight * error.light;
        noise += weight * weight * error.noise_variance;
        weighted.push_back({weight * error.square, weight * error.light, 0.0});
    }
};

}  // namespace

SpotCheck::Part::Part(std::vector<Pixel> chosen, std::uint64_t seed)
    : pixels(std::move(chosen)),
      paths(
          [this] {
              std::vector<std::uint32_t> numbers;
              for (const Pixel& pixel : pixels) {
                  numbers.push_back(pixel.number);
              }
              return numbers;
          }(),
          seed) {}

SpotCheck::SpotCheck(std::shared_ptr<const TracedScene> scene, const Camera& camera,
                     glm::uvec2 size, std::uint64_t seed)
    : scene_(std::move(scene)),
      camera_(scene_->rays, camera, size),
      seed_(seed),
      sample_(choose(size, seed), mixed_bits(seed)) {}

/// One of each square of pixels, without those that are not measured.
std::vector<SpotCheck::Pixel> SpotCheck::choose(glm::uvec2 size, std::uint64_t seed) {
    const double all = static_cast<double>(size.x) * size.y;
    const auto side =
        static_cast<std::uint32_t>(std::max(std::lround(std::sqrt(all / about_pixels)), 1L));
    const glm::uvec2 squares = (size + side - 1U) / side;
    sampled_share_ = static_cast<double>(squares.x) * squares.y / all;
    std::vector<Pixel> chosen(std::size_t{squares.x} * squares.y);
    tbb::parallel_for(std::size_t{0}, chosen.size(), [&](std::size_t i) {
        const auto index = static_cast<std::uint32_t>(i);
        const glm::uvec2 corner = side * glm::uvec2(index % squares.x, index / squares.x);
        const glm::uvec2 extent = glm::min(glm::uvec2(side), size - corner);
        RandomStream random(seed, i);
        const glm::dvec2 within = random.next_pair() * glm::dvec2(extent);
        const glm::uvec2 at = corner + glm::min(glm::uvec2(within), extent - 1U);
        if (pixel_is_measured(scene_->rays, camera_, at)) {
            chosen[i] = {at.y * size.x + at.x, static_cast<double>(extent.x) * extent.y};
        }
    });
    std::erase_if(chosen, [](const Pixel& pixel) { return pixel.weight == 0.0; });
    return chosen;
}

/// Those that are furthest from their neighbours and are measured, but for those that are known.
std::vector<SpotCheck::Pixel> SpotCheck::new_sparks(std::span<const glm::vec4> picture) {
    const glm::uvec2 size = camera_.size();
    const std::vector<float> distances = distances_from_neighbours(picture, size);
    std::vector<std::uint32_t> order(picture.size());
    std::iota(order.begin(), order.end(), 0U);
    const std::size_t candidates = std::min(order.size(), most_candidates);
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(candidates),
                      order.end(), [&](std::uint32_t a, std::uint32_t b) {
                          return distances[a] > distances[b] ||
                                 (distances[a] == distances[b] && a < b);
                      });
    std::vector<Pixel> found;
    std::size_t sparks = 0;
    std::size_t tests = 0;
    for (std::size_t i = 0; i < candidates && sparks < most_sparks; ++i) {
        const std::uint32_t number = order[i];
        Known& known = known_[number];
        if (known == Known::nothing && tests++ < most_tests) {
            const glm::uvec2 at(number % size.x, number / size.x);
            known =
                pixel_is_measured(scene_->rays, camera_, at) ? Known::measured : Known::left_out;
        }
        sparks += known == Known::spark || known == Known::measured ? 1 : 0;
        if (known == Known::measured) {
            known = Known::spark;
            found.push_back({number, 1.0});
        }
    }
    return found;
}

void SpotCheck::forget_sparks() {
    sparks_.clear();
    spark_count_ = 0;
    std::replace(known_.begin(), known_.end(), Known::spark, Known::measured);
}

void SpotCheck::look_for_sparks(std::span<const glm::vec4> picture) {
    if (sampled_share_ >= 1.0) {
        return;
    }
    known_.resize(picture.size(), Known::nothing);
    if (spark_count_ > most_kept) {
        forget_sparks();
    }
    std::vector<Pixel> found = new_sparks(picture);
    ++looks_;
    if (!found.empty()) {
        spark_count_ += found.size();
        add_round(sparks_.emplace_back(std::move(found), mixed_bits(seed_ + looks_)));
    }
}

void SpotCheck::add_round(Part& part) const {
    for (std::uint32_t batch = 0; batch < ImageEstimate::batches; ++batch) {
        part.paths.add_pass(camera_, [this](const glm::dvec3& origin, const glm::dvec3& direction,
                                            PixelSampler& sampler) {
            return scene_->paths.radiance(origin, direction, sampler);
        });
    }
}

void SpotCheck::add_round() {
    add_round(sample_);
    for (Part& part : sparks_) {
        add_round(part);
    }
}

SquaredError SpotCheck::measure(std::span<const glm::vec4> picture) const {
    const auto add = [&](ErrorSums& sums, const Part& part, std::size_t i) {
        const Pixel& pixel = part.pixels[i];
        sums.add(pixel_error(part.paths, i, glm::dvec3(picture[pixel.number])), pixel.weight);
    };
    ErrorSums sparks;
    for (const Part& part : sparks_) {
        for (std::size_t i = 0; i < part.pixels.size(); ++i) {
            add(sparks, part, i);
        }
    }
    ErrorSums others;  // chosen ones stand for what is no spark
    for (std::size_t i = 0; i < sample_.pixels.size(); ++i) {
        if (known_.empty() || known_[sample_.pixels[i].number] != Known::spark) {
            add(others, sample_, i);
        }
    }
    const double light = sparks.light + others.light;
    if (rounds() == 0 || !(light > 0.0)) {
        return {0.0, std::numeric_limits<double>::infinity()};
    }
    const double ratio = (sparks.square + others.square) / light;
    // Of the ratio of two sums; what pixels scatter by contains the noise of their paths.
    double scatter = 0.0;
    for (const PixelError& pixel : others.weighted) {
        const double deviation = pixel.square - ratio * pixel.light;
        scatter += deviation * deviation;
    }
    const double variance = std::max(sparks.noise, 0.0) +
                            sampled_share_ * std::max(others.noise, 0.0) +
                            (1.0 - sampled_share_) * scatter;
    return {ratio, std::sqrt(variance) / light};
}

}  // namespace raybundle
