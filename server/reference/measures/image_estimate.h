// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "reference/camera_rays.h"
#include "reference/measures/batch_scatter.h"
#include "reference/sampling/random.h"

namespace raybundle {

/// Radiance that arrives at `origin` against `direction` (own space of the ray scene), cd/m².
using RadianceEstimator = std::function<glm::dvec3(
    const glm::dvec3& origin, const glm::dvec3& direction, PixelSampler& sampler)>;

/// Light for a pixel other than the one being sampled: its part of one pass' picture, cd/m².
struct Splat {
    std::size_t pixel = 0;
    glm::dvec3 value{0.0};
};

/// An estimator that may add to other pixels too.
using SplattingEstimator =
    std::function<glm::dvec3(const glm::dvec3& origin, const glm::dvec3& direction,
                             PixelSampler& sampler, std::vector<Splat>& splats)>;

/// A sample's ray from the eye and the numbers for the rest of its path.
struct PixelRay {
    glm::dvec3 direction;  ///< unit
    PixelSampler sampler;
};

/// An estimator of some pixels near each other at once: sets the radiance of each ray.
using TileEstimator = std::function<void(const glm::dvec3& origin, std::span<PixelRay> rays,
                                         std::span<glm::dvec3> radiance)>;

/// What a pixel measures: the mean over its area, or its centre alone, as the viewers' geometry
/// buffers do.
enum class PixelFilter { box, centre };

/// A picture as the mean of samples of its pixels. The samples
/// form independently randomised batches, which give the standard errors. Row 0 at the top.
class ImageEstimate {
  public:
    static constexpr std::uint32_t batches = 8;

    ImageEstimate(glm::uvec2 size, std::uint64_t seed, PixelFilter filter = PixelFilter::box);
    /// Of some pixels of a picture alone, given by their numbers row by row: what is said of pixel
    /// i here is of pixels[i].
    ImageEstimate(std::span<const std::uint32_t> pixels, std::uint64_t seed,
                  PixelFilter filter = PixelFilter::box);

    /// Adds one sample to every pixel. The result depends on the seed and the number of passes
    /// alone, not on the number of threads.
    void add_pass(const CameraRays& camera, const RadianceEstimator& estimator);
    /// The same; splats are added in order of the pixels that they come from.
    void add_splatting_pass(const CameraRays& camera, const SplattingEstimator& estimator);

    /// The same for square tiles of pixels at a time, `side` pixels wide but at the picture's right
    /// and lower edges, whose estimates may depend on each other. For whole pictures only.
    void add_tiled_pass(const CameraRays& camera, std::uint32_t side,
                        const TileEstimator& estimator);

    [[nodiscard]] const glm::uvec2& size() const { return size_; }
    [[nodiscard]] std::uint64_t passes() const { return passes_; }
    [[nodiscard]] std::uint64_t non_finite() const { return non_finite_; }  ///< samples dropped
    [[nodiscard]] glm::dvec3 mean(std::size_t pixel) const;                 ///< cd/m²
    /// Of the mean, cd/m²; infinite before every batch has a sample.
    [[nodiscard]] glm::dvec3 standard_error(std::size_t pixel) const;
    /// Mean of one batch's samples, cd/m²; before it has any 0.
    [[nodiscard]] glm::dvec3 batch_mean(std::size_t pixel, std::uint32_t batch) const;
    [[nodiscard]] std::vector<glm::dvec3> means() const;
    [[nodiscard]] std::size_t bytes() const { return sums_.size() * sizeof(glm::dvec3); }
    /// measured: pixels that count, row by row; empty: all. Nothing is known before every batch has
    /// a sample.
    [[nodiscard]] ImageError error(const std::vector<bool>& measured) const;

  private:
    [[nodiscard]] PixelRay next_ray(std::size_t pixel, const CameraRays& camera) const;
    [[nodiscard]] BatchScatter scatter(std::size_t first, std::size_t last,
                                       const std::vector<bool>& measured) const;
    /// False where the value is not finite and was dropped.
    bool add(std::size_t pixel, const glm::dvec3& value);

    [[nodiscard]] std::uint64_t samples_of(std::uint32_t batch) const {
        return passes_ / batches + (batch < passes_ % batches ? 1 : 0);
    }

    glm::uvec2 size_;
    std::vector<std::uint32_t> pixels_;  // of the picture; empty: all
    std::uint64_t seed_;
    PixelFilter filter_;
    std::uint64_t passes_ = 0;
    std::uint64_t non_finite_ = 0;
    std::vector<glm::dvec3> sums_;  // [pixel * batches + batch]
};

}  // namespace raybundle
