// SPDX-License-Identifier: Apache-2.0
#include "measure/glare/position_index.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raybundle {

Gaze::Gaze(const glm::dvec3& view) : forward(glm::normalize(view)) {
    const glm::dvec3 vertical(0.0, 1.0, 0.0);
    up = glm::normalize(vertical - glm::dot(vertical, forward) * forward);
}

double guth_index(const Gaze& gaze, const glm::dvec3& direction) {
    const double along = glm::dot(direction, gaze.forward);
    const glm::dvec3 aside = direction - along * gaze.forward;
    const double across = glm::length(aside);
    if (!(across > 0.0)) {
        return 1.0;
    }
    const double sigma = glm::degrees(std::atan2(across, along));
    const double tau =
        glm::degrees(std::acos(std::clamp(glm::dot(aside, gaze.up) / across, -1.0, 1.0)));
    return std::exp((35.2 - 0.31889 * tau - 1.22 * std::exp(-2.0 * tau / 9.0)) * 1e-3 * sigma +
                    (21.0 + 0.26667 * tau - 0.002963 * tau * tau) * 1e-5 * sigma * sigma);
}

double position_index(const Gaze& gaze, const glm::dvec3& direction) {
    if (glm::dot(direction, gaze.up) >= 0.0) {
        return guth_index(gaze, direction);
    }
    const double along = glm::dot(direction, gaze.forward);
    const double ratio = along > 0.0 ? glm::length(direction - along * gaze.forward) / along
                                     : std::numeric_limits<double>::infinity();
    return 1.0 + (ratio < 0.6 ? 0.8 : 1.2) * ratio;
}

double height_ratio(const Gaze& gaze, const glm::dvec3& direction) {
    const double along = glm::dot(direction, gaze.forward);
    return along > 0.0 ? glm::dot(direction, gaze.up) / along
                       : std::numeric_limits<double>::infinity();
}

}  // namespace raybundle
