// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>

#include "solution/geometry/gpu_scene.h"
#include "view/error/error_interval.h"
#include "view/error/image_statistics.h"
#include "view/error/pixel_sums.h"

namespace raybundle {

/// How far a picture is from the true one, as its samples say, and how bright it is: makes
/// statistics of the sums over its pixels, and remembers what was known before it changed.
class PictureError {
  public:
    /// A picture when its sums were requested.
    struct Picture {
        std::uint64_t samples = 0;
        SampleOrder order = SampleOrder::low_discrepancy;
        unsigned grid = 1;         ///< see ViewerImage::refine()
        bool keeps_light = false;  ///< of before a change
    };

    explicit PictureError(const GpuScene& scene) : scene_(scene) {}

    [[nodiscard]] const ImageStatistics& statistics() const { return statistics_; }
    /// Nothing is known.
    void forget();
    /// What was known is of another scene.
    void begin_change();
    /// What the pixels show is another thing from now on, or of other accuracy.
    void restart();
    /// New sums have come in.
    void evaluate(const PixelSums::Sums& sums, const Picture& picture, SampleBatches& batches);

    /// Relative error of what was shown before the sums of scatter began.
    [[nodiscard]] double error_before() const { return error_before_; }
    /// Exposure, EV, that puts the mean logarithm of luminance at mid-grey. What shows no light
    /// stays dark; darker_than: ImageStatistics::darker_than().
    [[nodiscard]] float automatic_exposure(std::optional<double> darker_than) const;

  private:
    struct LightThen {
        std::uint64_t samples = 0;
        double light = 0.0;  // mean luminance, radiance units
    };
    void note_light(std::uint64_t samples, double mean);
    void judge_brightness(const PixelSums::Sums& sums, std::uint64_t samples);
    [[nodiscard]] SuspectedError suspected_error(const PixelSums::Sums& sums,
                                                 const Picture& picture) const;

    const GpuScene& scene_;
    ImageStatistics statistics_;
    double sampling_noise_ = 1.0;  // of the last statistics: noise without what is suspected
    double error_before_ = 1.0;
    LightThen earlier_, latest_;  // see note_light()
    double light_before_ = 0.0;   // cd/m², root mean square before the last change; 0: none yet
};

}  // namespace raybundle
