// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace raybundle {

/// What an eye looks along, Y being up: a line of sight that is not vertical.
struct Gaze {
    /// view: of any length but 0, not vertical.
    explicit Gaze(const glm::dvec3& view);

    glm::dvec3 forward;  ///< unit
    glm::dvec3 up;       ///< unit, across it
};

/// Guth's position index p of a source in a unit direction, by the formula of CIE 117:1995:
///   ln p = (35.2 - 0.31889 tau - 1.22 exp(-2 tau/9)) 1e-3 sigma
///        + (21 + 0.26667 tau - 0.002963 tau^2) 1e-5 sigma^2,
/// tau degrees from the vertical of the plane through source and line of sight, sigma degrees
/// between line of sight and source. For sources above the line of sight.
double guth_index(const Gaze& gaze, const glm::dvec3& direction);

/// The same also below it, where P = 1 + 0.8 R/D up to R = 0.6 D and 1 + 1.2 R/D beyond, R from the
/// line of sight and D along it (Iwata, Tokura 1997; as DGP has it).
double position_index(const Gaze& gaze, const glm::dvec3& direction);

/// Height above the line of sight over the distance along it; infinite beside and behind the eye.
double height_ratio(const Gaze& gaze, const glm::dvec3& direction);

}  // namespace raybundle
