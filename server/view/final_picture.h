// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "reference/spot_check.h"
#include "view/error/measured_error.h"
#include "view/viewer_image.h"

namespace raybundle {

/// How finely a final picture is drawn.
enum class PixelGrid {
    adaptive,  ///< as finely as its noise makes worth while
    centres,   ///< light at the centres of pixels alone, as viewers see it
};

/// A picture that is made to be kept: its camera rests. Light changes within pixels, along the foot
/// of a wall or in a narrow slot, and more so in small pictures, where no number of samples at
/// their centres tells of it. So once noise is not much more than what the pixels do not resolve,
/// each is drawn as 2 x 2, then 4 x 4, in the end 8 x 8 of them at staggered places, whose mean it
/// is. No clock decides, so that runs of one seed are equal to the bit.
class FinalPicture {
  public:
    FinalPicture(const GpuScene& scene, const RadianceStore& store, const ViewPrograms& programs,
                 const Camera& camera, glm::uvec2 size, PixelGrid grid = PixelGrid::adaptive);

    /// From now on errors are measured by path tracing some pixels, too. Its paths are traced by
    /// measure(), so that they take a small share of the time.
    void check_by(std::unique_ptr<SpotCheck> check) { check_ = std::move(check); }

    /// To be called before each iteration: smooth edges, and finer pixels when they are due.
    void prepare();
    /// What takes part in the iterations.
    [[nodiscard]] BundleReceiver& receiver() { return image_; }

    /// Error and brightness as they are now: by its samples, and by what was measured of some
    /// pixels. Synchronous.
    const ImageStatistics& measure();
    /// As measured last.
    [[nodiscard]] const ImageStatistics& statistics() const { return statistics_; }
    /// What was measured last, and of how many pixels by how many paths each; nothing before, or
    /// without a check.
    struct Checked {
        SquaredError square;  ///< squared relRMSE
        std::size_t pixels = 0;
        std::uint64_t paths = 0;
    };
    [[nodiscard]] const std::optional<Checked>& checked() const { return checked_; }
    /// Whether a target for the error is met, as measured last, or never will be.
    [[nodiscard]] bool meets(double target) const;
    /// Linear radiance of the pixels, cd/m², row 0 at the top. Synchronous.
    [[nodiscard]] std::vector<glm::vec4> read_radiance();
    /// RGBA bytes for display, exposed for the picture's mean, row 0 at the top. Synchronous.
    [[nodiscard]] std::vector<std::uint8_t> read_display();

    /// Factor of the samples that bring the upper end of the interval to a target, >= 1; infinite
    /// where none do. It foresees that pixels will be drawn more finely.
    [[nodiscard]] double samples_factor_to(double target) const;

    [[nodiscard]] glm::uvec2 size() const { return size_; }
    /// Pixels that each pixel is drawn with along an edge.
    [[nodiscard]] unsigned pixel_grid() const { return grid_; }
    [[nodiscard]] std::size_t bytes() const { return image_.bytes(); }

  private:
    [[nodiscard]] bool may_refine() const;
    [[nodiscard]] bool finer_is_due(unsigned grid, double unresolved, double noise) const;
    void measure_pixels();

    glm::uvec2 size_;
    unsigned most_grid_;
    unsigned grid_ = 1;
    std::uint64_t iterations_ = 0;
    std::uint64_t next_look_;
    ViewerImage image_;
    ImageStatistics statistics_, by_samples_;
    std::unique_ptr<SpotCheck> check_;  // may be null
    std::optional<Checked> checked_;
    MeasuredError measured_;
    std::uint64_t next_check_ = 0;
};

}  // namespace raybundle
