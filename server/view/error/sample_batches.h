// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "view/error/error_interval.h"

namespace raybundle {

/// Samples of a picture so far, each of a weight that all its pixels share.
struct SampleWeights {
    std::uint64_t samples = 0;
    float sum = 0.0F;
    float squares = 0.0F;  ///< of weights
};

/// What a picture's batches of samples, from one request of statistics to the next, say of the
/// noise beside the scatter of single samples. Sums over its probe pixels come from
/// shaders/view/view_statistics.comp.
class SampleBatches {
  public:
    /// Sums over the picture when a batch has ended. d, e: deviations of this batch and of the one
    /// before from all earlier samples, as shown luminance.
    struct Sums {
        double product = 0.0;     ///< d e
        double square = 0.0;      ///< d d
        double other = 0.0;       ///< e e
        double variance = 0.0;    ///< of the mean were batches independent
        double of_samples = 0.0;  ///< the same were samples independent
    };

    /// Samples begin anew. How many modes their noise has is not forgotten.
    void restart();
    /// A batch ends with these samples; false where there is nothing in it.
    bool end(const SampleWeights& all, SampleOrder order);
    /// Weight of all samples when the last batch but one ended, and sum of squared weights of all
    /// batches, for the shader.
    [[nodiscard]] float begin() const { return begin_; }
    [[nodiscard]] float squares() const { return squares_; }
    /// Of the batch that end() was called for last; nothing where that was empty.
    void take(const Sums& sums);

    /// Variance of the mean of all samples over what their scatter says, >= 1: samples hang
    /// together where the iterate that they transfer changes slowly. Batches of one low-discrepancy
    /// sequence avoid each other, so that what is below 1 says nothing.
    [[nodiscard]] double correlation() const { return correlation_; }
    /// Half the width of the 95 % interval of the logarithm of the picture's error, by luck alone.
    /// A picture has few independent modes of noise, m = (sum v)^2 / (sum v^2) over the eigenvalues
    /// v of the covariance of its pixels, and its squared error scatters from run to run by
    /// sqrt(2/m) of its mean (Satterthwaite 1946, "An Approximate Distribution of Estimates of
    /// Variance Components"). Between independent batches the squared cosine of d and e has the
    /// mean 1/m; that batches avoid each other moves the mean of the cosine, not its variance.
    [[nodiscard]] double luck(SampleOrder order) const;

  private:
    float begin_ = 0.0F;
    float squares_ = 0.0F;
    SampleWeights last_;  // at the end of the last batch
    double gained_ =
        0.0;              // squares of the samples' weights times variance_of_mean() of their batch
    unsigned count_ = 0;  // of batches
    bool empty_ = true;   // the last batch
    double correlation_ = 1.0;
    double cosines_ = 0.0, sum_ = 0.0, squared_ = 0.0;  // their number, sum and sum of squares
};

}  // namespace raybundle
