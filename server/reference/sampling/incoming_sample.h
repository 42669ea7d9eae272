// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace raybundle {

/// Light that arrives at a point. Own space of the ray scene.
struct IncomingLight {
    glm::vec3 power{0.0F};          ///< lm per unit of own area
    glm::vec3 position{0.0F};       ///< where it arrives
    glm::vec3 direction{0.0F};      ///< to where it came from, unit
    float inverse_distance = 0.0F;  ///< of where it came from; 0: the sky
};

/// The random representation of the light that a glossy patch receives (ch. 7.2): of all that came
/// in, one sample, kept in proportion to its importance s, and the sum of all s. For any function g
/// of a direction, importance_sum * power/importance * g(direction) has the mean over the kept
/// sample that summing power * g(direction) over everything that came in would give.
///
/// Ch. 7.2 keeps samples by Metropolis acceptance, min(1, s_new/s_kept), which has that mean only
/// in the long run. Particles are independent of what is kept, so a reservoir (Chao 1982,
/// "A General Purpose Unequal Probability Sampling Plan": s_new/(sum of all s)) has it at once.
/// The importance is positive wherever anything but the main part is reflected, as in
/// scene/material/reflectance_table.h, so nothing is divided by an albedo that may be 0.
///
/// Its source is kept and not its direction alone, so that the patch mirrors the source as a plane
/// does and not as a point.
struct IncomingSample {
    IncomingLight light;
    double importance = 0.0;  ///< of the light kept; 0: nothing came in
    double importance_sum = 0.0;

    /// Direction from a point of the patch to the source, unit.
    [[nodiscard]] glm::dvec3 direction_from(const glm::dvec3& point) const {
        const glm::dvec3 aside = glm::dvec3(light.position) - point;
        return glm::normalize(glm::dvec3(light.direction) + aside * double{light.inverse_distance});
    }

    /// u: uniform in (0, 1).
    void add(const IncomingLight& arrived, double new_importance, double u) {
        importance_sum += new_importance;
        if (u * importance_sum < new_importance) {
            light = arrived;
            importance = new_importance;
        }
    }
};

}  // namespace raybundle
