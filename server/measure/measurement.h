// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "measure/glare/glare_rating.h"
#include "measure/interval.h"

namespace raybundle {

struct CalculationPoint {
    glm::dvec3 position{0.0};   ///< world space, m
    glm::dvec3 direction{0.0};  ///< that it faces, where the quantity has one; any length but 0
};

/// What all points together say, with 95 % intervals.
struct MeasurementSummary {
    Interval mean;     ///< of the points
    Interval minimum;  ///< of the points
    Interval maximum;
    Interval uniformity;  ///< Uo, minimum over mean; of glare 0
    Interval diversity;   ///< Ud, minimum over maximum; of glare 0
};

/// Points at which something is measured, better with each round of samples. What comes out depends
/// on the seed and the number of rounds alone.
class Measurement {
  public:
    virtual ~Measurement() = default;

    /// One more sample of each batch for the next `count` points, on all threads.
    virtual void add_samples(std::size_t count) = 0;
    /// For all points.
    void add_round() { add_samples(points().size()); }

    /// Rounds that all points have.
    [[nodiscard]] virtual std::uint64_t rounds() const = 0;
    [[nodiscard]] virtual std::span<const CalculationPoint> points() const = 0;
    /// Points that lie in a solid: nothing is measured there.
    [[nodiscard]] virtual bool inside(std::size_t point) const = 0;
    [[nodiscard]] virtual std::size_t measured() const = 0;
    /// At each point, 95 %; where nothing is known, 0.
    [[nodiscard]] virtual std::vector<Interval> values() const = 0;
    /// Of what is measured; nothing where no point has a value.
    [[nodiscard]] virtual std::optional<MeasurementSummary> all() const = 0;
    /// Half of the widest interval over the mean of all points; infinite before least_rounds.
    [[nodiscard]] virtual double relative_error() const = 0;
    /// Of each point, where glare is measured; else empty.
    [[nodiscard]] virtual std::vector<GlareRating> glare() const { return {}; }

  protected:
    Measurement() = default;
    Measurement(const Measurement&) = default;
    Measurement& operator=(const Measurement&) = default;
};

}  // namespace raybundle
