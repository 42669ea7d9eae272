// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "reference/sampling/discrete_distribution.h"
#include "scene/scene.h"

namespace raybundle {

/// Random directions to a scene's sky by its radiance: cells of equal solid angle, each chosen by
/// its brightest of some samples, a share of all evenly.
class SkyDistribution {
  public:
    explicit SkyDistribution(const Scene& scene);

    /// The sky is as bright in all directions: nothing can be drawn.
    [[nodiscard]] bool uniform() const { return cells_.empty(); }
    /// Unit, world; from uniform random numbers.
    [[nodiscard]] glm::dvec3 sample(double choice, const glm::dvec2& at) const;
    /// Of sample(), 1/sr.
    [[nodiscard]] double density(const glm::dvec3& direction) const;

  private:
    DiscreteDistribution cells_;
};

}  // namespace raybundle
