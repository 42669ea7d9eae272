// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "measure/glare/glare_sources.h"
#include "measure/glare/position_index.h"
#include "measure/measurement.h"
#include "measure/receiver.h"

namespace raybundle {

struct UgrSettings {
    std::vector<glm::dvec3> views;  ///< for all points; empty: each point has its own direction
    bool small_sources = false;     ///< those below 0.005 m² by CIE 147: 200 I²/r² for L² omega
    std::uint64_t seed = 1;
};

/// Horizontal directions, evenly all round, the first one along `first`.
std::vector<glm::dvec3> views_all_round(std::size_t count, const glm::dvec3& first);

/// Unified glare rating (CIE 117:1995) of eyes' places, each in one or several views of which the
/// worst counts:
///   UGR = 8 log10(0.25/Lb sum L² omega/p²),
/// L and omega of the part of a luminaire that is seen, through panes too, p Guth's index of its
/// middle, Lb = Eind/pi with the illuminance at the eye, across the line of sight, of all light but
/// what comes straight from luminaires. Daylight is background.
///
/// Luminaires below the line of sight, and those higher above it than twice their distance along
/// it, are left out and counted. No number is given where one covers more than 0.1 sr (CIE 117), or
/// where those below 0.005 m² of projected luminous area matter, unless they are asked for.
///
/// Intervals: of Eind from batches of paths, of the sources by the jackknife over batches of rays;
/// both are independent, and their relative errors add up in the logarithm.
class UgrMeasurement : public Measurement {
  public:
    static constexpr std::size_t most_points = 1024;
    static constexpr std::size_t most_views = 8;

    /// Throws std::invalid_argument where there are no points, or more than most_points.
    UgrMeasurement(std::shared_ptr<const MeasuredScene> scene, std::vector<CalculationPoint> points,
                   UgrSettings settings);

    void add_samples(std::size_t count) override;
    [[nodiscard]] std::uint64_t rounds() const override { return steps_ / points_.size(); }
    [[nodiscard]] std::span<const CalculationPoint> points() const override { return points_; }
    [[nodiscard]] bool inside(std::size_t point) const override { return inside_[point]; }
    [[nodiscard]] std::size_t measured() const override { return measured_; }
    [[nodiscard]] std::vector<Interval> values() const override;
    /// Of the points that are rated.
    [[nodiscard]] std::optional<MeasurementSummary> all() const override;
    /// Half of the widest interval, of the sum in the logarithm.
    [[nodiscard]] double relative_error() const override;
    [[nodiscard]] std::vector<GlareRating> glare() const override;

  private:
    static constexpr std::size_t batches = SeenSource::batches;

    struct Background {
        double mean = 0.0;      ///< Eind, lx
        double variance = 0.0;  ///< relative
    };
    /// What glares in one view.
    struct Glaring {
        double sum = 0.0;       ///< L² omega/p²
        double variance = 0.0;  ///< relative
        double small = 0.0;     ///< of it, by sources that are too small
        GlareRating counts;
    };

    [[nodiscard]] std::size_t views() const {
        return settings_.views.empty() ? 1 : settings_.views.size();
    }
    [[nodiscard]] const Gaze& gaze(std::size_t point, std::size_t view) const {
        return gazes_[settings_.views.empty() ? point : view];
    }
    void add_sample(std::size_t point, std::uint64_t round);
    void look_around(std::size_t point);
    [[nodiscard]] double illuminance_term(const SeenSource& seen, std::size_t without) const;
    [[nodiscard]] Glaring glaring(std::size_t point, std::size_t view) const;
    [[nodiscard]] Background background(std::size_t point, std::size_t view) const;
    [[nodiscard]] double common_variance() const;
    [[nodiscard]] GlareRating rate(std::size_t point, std::size_t view,
                                   double least_variance) const;
    [[nodiscard]] std::vector<GlareRating> rate_all() const;
    void name_sources(std::size_t point, const Gaze& gaze, GlareRating& rating) const;

    std::shared_ptr<const MeasuredScene> scene_;
    std::vector<CalculationPoint> points_;
    UgrSettings settings_;
    std::vector<Gaze> gazes_;
    std::vector<GlareSource> sources_;
    std::vector<glm::dvec3> places_;  // own space
    std::vector<char> inside_;
    std::vector<std::vector<SeenSource>> seen_;  // of the points, from their first sample on
    std::vector<double> sums_;                   // lx, [(point * views + view) * batches + batch]
    std::uint64_t steps_ = 0;
    std::size_t measured_ = 0;
};

}  // namespace raybundle
