// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

namespace raybundle {

/// What viewers cost, learnt from measurements: an iteration takes a + b * pixels milliseconds, a
/// frame c * pixels; large frames say more about c than small ones. Forgets slowly. Has no clock of
/// its own.
class CostModel {
  public:
    void note_iteration(double milliseconds, double pixels);
    void note_frame(double milliseconds, double pixels);

    /// Time in which every viewer gets a frame and the solver an iteration, ms, where all viewers'
    /// pictures together have so many pixels.
    [[nodiscard]] double round_ms(double pixels) const;

    /// What so many pixels that gather light add to an iteration, ms.
    [[nodiscard]] double receive_ms(double pixels) const { return iteration_line().slope * pixels; }

    /// Whether a picture of this size fits beside `present` pixels, all served in `limit_ms`.
    /// Otherwise the largest of the same shape that would, or nothing where none of at least
    /// min_pixels pixels does.
    struct Verdict {
        bool fits = true;
        std::optional<std::pair<std::uint32_t, std::uint32_t>> would_fit;  ///< width, height
    };
    [[nodiscard]] Verdict admit(std::uint32_t width, std::uint32_t height, double present,
                                double limit_ms) const;

    static constexpr double min_pixels = 64.0 * 64.0;

  private:
    /// Before anything is measured, as one observation of little weight: an 800x800 viewer costs
    /// 12 ms an iteration and 28 ms a frame on two cores.
    static constexpr double prior_receive_ms = 1.9e-5;  ///< per pixel
    static constexpr double prior_frame_ms = 4.4e-5;    ///< per pixel

    struct Line {
        double base = 0.0;
        double slope = prior_receive_ms;
    };
    [[nodiscard]] Line iteration_line() const;
    [[nodiscard]] double frame_ms_per_pixel() const;

    // Exponentially weighted sums over iterations: weight, x, y, x², xy; x in megapixels.
    double w_ = 0.0, x_ = 0.0, y_ = 0.0, xx_ = 0.0, xy_ = 0.0;
    // The same over frames.
    double frame_xx_ = 0.0, frame_xy_ = 0.0;
};

}  // namespace raybundle
