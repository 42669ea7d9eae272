// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "measure/glare/glare_sources.h"
#include "measure/glare/position_index.h"
#include "measure/measurement.h"

namespace raybundle {

/// Pixels of a fisheye picture, all of the same solid angle: rows of equal height over the
/// hemisphere ahead, the first one about the line of sight.
class Fisheye {
  public:
    static constexpr std::size_t rows = 48;
    static constexpr std::size_t columns = 96;
    static constexpr std::size_t pixels = rows * columns;
    static constexpr double solid_angle = 2.0 * 3.14159265358979323846 / pixels;  ///< sr

    /// Unit direction of a place within a pixel, both in [0, 1).
    static glm::dvec3 direction(const Gaze& gaze, std::size_t pixel, const glm::dvec2& at);
    static glm::dvec3 middle(const Gaze& gaze, std::size_t pixel) {
        return direction(gaze, pixel, glm::dvec2(0.5));
    }
};

struct DgpSettings {
    std::vector<glm::dvec3> views;  ///< for all points; empty: each point has its own direction
    std::uint64_t seed = 1;
};

/// Daylight glare probability (Wienold, Christoffersen 2006) of eyes' places, each in one or
/// several views of which the worst counts:
///   DGP = 5.87e-5 Ev + 0.0918 log10(1 + sum Ls² omega/(Ev^1.87 P²)) + 0.16,
/// from a fisheye picture by paths. Luminaires and suns, which may be smaller than its pixels, are
/// seen for themselves; of the rest each pixel is a source of its own. What is brighter than five
/// times the picture's mean glares. The square of a pixel's luminance is that of independent
/// batches, times each other, so that noise does not add to it. Intervals by the jackknife.
///
/// Lights without size are in Ev alone: no picture shows them, and they have no luminance.
class DgpMeasurement : public Measurement {
  public:
    static constexpr std::size_t most_points = 16;
    static constexpr std::size_t most_views = 8;
    /// A round holds one sample of each batch in so many of the pixels.
    static constexpr std::size_t pixels_at_once = 144;
    /// Rounds until each pixel has been seen by all batches.
    static constexpr std::size_t pass = Fisheye::pixels / pixels_at_once;

    /// Throws std::invalid_argument where there are no points, or more than most_points.
    DgpMeasurement(std::shared_ptr<const MeasuredScene> scene, std::vector<CalculationPoint> points,
                   DgpSettings settings);

    void add_samples(std::size_t count) override;
    [[nodiscard]] std::uint64_t rounds() const override { return steps_ / points_.size(); }
    [[nodiscard]] std::span<const CalculationPoint> points() const override { return points_; }
    [[nodiscard]] bool inside(std::size_t point) const override { return inside_[point]; }
    [[nodiscard]] std::size_t measured() const override { return measured_; }
    [[nodiscard]] std::vector<Interval> values() const override;
    [[nodiscard]] std::optional<MeasurementSummary> all() const override;
    /// Half of the widest interval over its value; infinite before the first pass.
    [[nodiscard]] double relative_error() const override;
    [[nodiscard]] std::vector<GlareRating> glare() const override;

  private:
    static constexpr std::size_t batches = SeenSource::batches;
    static constexpr std::size_t all_batches = batches;

    /// Something that is seen for itself.
    struct Source {
        SeenSource seen;
        std::string name;
        std::uint32_t light = 0;
    };
    struct View {
        std::vector<float> sums;  ///< cd/m², [pixel * batches + batch]
        std::uint64_t rounds = 0;
    };
    struct Half {
        double mean = 0.0;    ///< cd/m²
        double square = 0.0;  ///< of the luminance, without that of its noise
    };
    using Halves = std::array<Half, 2>;  ///< a pixel by one half of the batches and by the other
    struct Picture {
        std::vector<double> luminance;  ///< of the pixels, cd/m²
        std::vector<Halves> halves;
    };
    [[nodiscard]] static double glaring_square(const Halves& halves, double least);

    [[nodiscard]] std::size_t views() const {
        return settings_.views.empty() ? 1 : settings_.views.size();
    }
    [[nodiscard]] const Gaze& gaze(std::size_t point, std::size_t view) const {
        return gazes_[settings_.views.empty() ? point : view];
    }
    void look_around(std::size_t point);
    void see_suns(std::size_t point);
    void add_sample(std::size_t point, std::size_t view, std::uint64_t round);
    [[nodiscard]] Picture picture(const View& view, std::size_t without) const;
    [[nodiscard]] double illuminance(const Gaze& eye, const Picture& picture, std::size_t point,
                                     std::size_t without) const;
    [[nodiscard]] double threshold(const Gaze& eye, const Picture& picture,
                                   std::size_t point) const;
    [[nodiscard]] double dgp(const Gaze& eye, const Picture& picture, std::size_t point,
                             double threshold, std::size_t without) const;
    [[nodiscard]] GlareRating rate(std::size_t point, std::size_t view) const;
    void name_sources(const Gaze& eye, const Picture& picture, std::size_t point, double least,
                      GlareRating& rating) const;
    [[nodiscard]] std::vector<double> ring_luminances(const Gaze& eye, const Picture& picture,
                                                      std::size_t point) const;

    std::shared_ptr<const MeasuredScene> scene_;
    std::vector<CalculationPoint> points_;
    DgpSettings settings_;
    std::vector<Gaze> gazes_;
    std::vector<GlareSource> sources_;
    std::vector<glm::dvec3> places_;  // own space
    std::vector<char> inside_;
    std::vector<std::vector<Source>> seen_;  // of the points
    std::vector<View> views_;                // [point * views + view]
    std::uint64_t steps_ = 0;
    std::size_t measured_ = 0;
};

}  // namespace raybundle
