// SPDX-License-Identifier: Apache-2.0
#include "reference/spot_check.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "reference/emitter_pixels.h"
#include "scene/environment.h"

namespace raybundle {
namespace {

constexpr double about_pixels = 1500.0;  // that are checked of a large picture
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

}  // namespace

SpotCheck::SpotCheck(std::shared_ptr<const TracedScene> scene, const Camera& camera,
                     glm::uvec2 size, std::uint64_t seed)
    : scene_(std::move(scene)),
      camera_(scene_->rays, camera, size),
      pixels_(choose(size, seed)),
      paths_(
          [this] {
              std::vector<std::uint32_t> numbers;
              for (const Pixel& pixel : pixels_) {
                  numbers.push_back(pixel.number);
              }
              return numbers;
          }(),
          mixed_bits(seed)) {}

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
        if (is_measured(glm::ivec2(at))) {
            chosen[i] = {at.y * size.x + at.x, static_cast<double>(extent.x) * extent.y};
        }
    });
    std::erase_if(chosen, [](const Pixel& pixel) { return pixel.weight == 0.0; });
    return chosen;
}

/// Neither the pixel nor one of its 8 neighbours sees an emitter or the sky.
bool SpotCheck::is_measured(glm::ivec2 at) const {
    const auto size = glm::ivec2(camera_.size());
    const bool sky = has_sky(scene_->rays.scene());
    for (int y = std::max(at.y - 1, 0); y <= std::min(at.y + 1, size.y - 1); ++y) {
        for (int x = std::max(at.x - 1, 0); x <= std::min(at.x + 1, size.x - 1); ++x) {
            const auto pixel =
                static_cast<std::size_t>(y) * camera_.size().x + static_cast<std::size_t>(x);
            const glm::dvec3 through_centre =
                camera_.direction(camera_.corner(pixel) + glm::dvec2(0.5));
            if ((sky && !scene_->rays.trace(camera_.origin(), through_centre)) ||
                pixel_sees_emitter(scene_->rays, camera_, pixel)) {
                return false;
            }
        }
    }
    return true;
}

void SpotCheck::add_round() {
    for (std::uint32_t batch = 0; batch < ImageEstimate::batches; ++batch) {
        paths_.add_pass(camera_, [this](const glm::dvec3& origin, const glm::dvec3& direction,
                                        PixelSampler& sampler) {
            return scene_->paths.radiance(origin, direction, sampler);
        });
    }
}

SquaredError SpotCheck::measure(std::span<const glm::vec4> picture) const {
    std::vector<PixelError> errors(pixels_.size());
    double square = 0.0;
    double light = 0.0;
    double noise = 0.0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        errors[i] = pixel_error(paths_, i, glm::dvec3(picture[pixels_[i].number]));
        square += pixels_[i].weight * errors[i].square;
        light += pixels_[i].weight * errors[i].light;
        noise += pixels_[i].weight * pixels_[i].weight * errors[i].noise_variance;
    }
    if (rounds() == 0 || !(light > 0.0)) {
        return {0.0, std::numeric_limits<double>::infinity()};
    }
    const double ratio = square / light;
    // Of the ratio of two sums; what pixels scatter by contains the noise of their paths.
    double scatter = 0.0;
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const double deviation = pixels_[i].weight * (errors[i].square - ratio * errors[i].light);
        scatter += deviation * deviation;
    }
    const double variance =
        sampled_share_ * std::max(noise, 0.0) + (1.0 - sampled_share_) * scatter;
    return {ratio, std::sqrt(variance) / light};
}

}  // namespace raybundle
