// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "measure/interval.h"
#include "measure/measurement.h"
#include "measure/point_paths.h"

namespace raybundle {

struct MeasurementSettings {
    Quantity quantity = Quantity::horizontal;
    bool direct = false;  ///< without light that surfaces have reflected
    double factor = 1.0;  ///< of all values, as a maintenance factor, or % per lx
    std::uint64_t seed = 1;
    // Of glare alone.
    std::vector<glm::dvec3> views{};  ///< for all points; empty: each point has its own direction
    bool small_sources = false;       ///< UgrSettings::small_sources
};

/// Calculation points that gather light path by path. The samples of a point form independently
/// randomised batches, each a low-discrepancy sequence of its own, whose scatter gives the
/// intervals by Student's t. What comes out depends on the seed and the number of rounds alone.
///
/// Few paths have not met yet what is rare, the inside of a lamp's shade, and a point that has not
/// scatters little. Reflected light is smooth in the air, and its noise alike at all points of an
/// area: no point's is taken to be less than the mean of all.
class PointMeasurement : public Measurement {
  public:
    static constexpr std::size_t most_points = 4096;
    static constexpr std::uint32_t batches = 16;
    /// Before so many, intervals may be too narrow: what 128 paths have not met is not in them.
    static constexpr std::uint64_t least_rounds = 8;

    /// Throws std::invalid_argument where there are no points or more than most_points.
    PointMeasurement(std::shared_ptr<const MeasuredScene> scene,
                     std::vector<CalculationPoint> points, const MeasurementSettings& settings);

    /// One more sample of each batch for the next `count` points, on all threads: around the
    /// points, so that each is at most a round ahead of the others.
    void add_samples(std::size_t count) override;

    [[nodiscard]] std::uint64_t rounds() const override { return steps_ / points_.size(); }
    [[nodiscard]] std::span<const CalculationPoint> points() const override { return points_; }
    [[nodiscard]] bool inside(std::size_t point) const override { return inside_[point]; }
    [[nodiscard]] std::size_t measured() const override { return measured_; }

    /// At each point, 95 %; before the first round nothing is known, nor inside solids.
    [[nodiscard]] std::vector<Interval> values() const override;
    /// Of all that are measured: there is one at least, and a round.
    ///
    /// Minimum and maximum by interval_of_smallest() and interval_of_largest(). Ratios take the
    /// ends of two intervals, each with half of the 5 %.
    [[nodiscard]] MeasurementSummary summary() const;
    [[nodiscard]] std::optional<MeasurementSummary> all() const override {
        return measured_ > 0 ? std::optional(summary()) : std::nullopt;
    }
    /// Half of the widest interval over the mean of all points; infinite before least_rounds.
    [[nodiscard]] double relative_error() const override;

  private:
    /// Mean of the batches and its variances.
    struct Scatter {
        double mean = 0.0;
        double variance = 0.0;
        double direct = 0.0, reflected = 0.0;  ///< of the two parts

        [[nodiscard]] double error() const { return std::sqrt(variance); }
    };
    struct Extremes {
        Interval mean, minimum, maximum;
    };
    [[nodiscard]] Scatter scatter(std::size_t point) const;
    [[nodiscard]] std::vector<Scatter> scatters() const;
    /// beyond: probability with which the truth lies beyond each end.
    [[nodiscard]] Extremes extremes(double beyond) const;
    [[nodiscard]] Scatter scatter_of_mean() const;
    [[nodiscard]] ArrivedLight batch_mean(std::size_t point, std::uint32_t batch) const;
    [[nodiscard]] std::uint64_t rounds_of(std::size_t point) const {
        return rounds() + (point < steps_ % points_.size() ? 1 : 0);
    }
    void add_sample(std::size_t point, std::uint64_t round);

    std::shared_ptr<const MeasuredScene> scene_;
    std::vector<CalculationPoint> points_;
    MeasurementSettings settings_;
    std::vector<Receiver> receivers_;
    std::vector<glm::dvec3> places_;  // own space
    std::vector<char> inside_;
    std::vector<double> fixed_;       // lx, exact
    std::vector<ArrivedLight> sums_;  // [point * batches + batch]
    std::uint64_t steps_ = 0;         // rounds of single points
    std::size_t measured_ = 0;
};

}  // namespace raybundle
