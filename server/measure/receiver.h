// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "reference/sampling/random.h"

namespace raybundle {

/// What is measured at a calculation point. Y is up.
enum class Quantity {
    horizontal,       ///< illuminance of a plane that faces up, lx
    vertical,         ///< of one that faces a horizontal direction, lx
    normal,           ///< of one that faces the point's own direction, lx
    cylindrical,      ///< of an upright cylinder, (1/pi) int L sin(theta) dw, lx
    semicylindrical,  ///< of its half that faces a direction,
                      ///< (1/pi) int L (1 + cos(alpha)) sin(theta) dw, lx
    daylight_factor,  ///< horizontal, by an overcast sky alone, over that outside, %
    ugr,              ///< unified glare rating of an eye's place (CIE 117:1995)
    dgp,              ///< daylight glare probability (Wienold, Christoffersen 2006)
};

/// Whether it rates what an eye sees, instead of light that arrives on a surface.
inline bool is_glare(Quantity quantity) {
    return quantity == Quantity::ugr || quantity == Quantity::dgp;
}

/// By its name on the wire and on the command line, upper or lower case.
std::optional<Quantity> quantity_named(const std::string& name);
const char* name_of(Quantity quantity);
/// "lx", "%" or "" of ratings.
const char* unit_of(Quantity quantity);

/// How a point receives light: the weight w(direction) of the radiance that arrives from there. All
/// weights have the integral pi over the sphere, so that a uniform sphere of luminance L gives pi L
/// and directions drawn with the density w/pi, 1/sr, bring pi L each.
class Receiver {
  public:
    /// direction: of vertical, normal and semicylindrical, not 0; of the others it does not count.
    Receiver(Quantity quantity, const glm::dvec3& direction);

    /// Of a unit direction, away from the point.
    [[nodiscard]] double weight(const glm::dvec3& direction) const;
    /// A unit direction with the density weight()/pi.
    [[nodiscard]] glm::dvec3 sample(Sampler& sampler) const;
    /// Unit; of cylinders up.
    [[nodiscard]] const glm::dvec3& axis() const { return axis_; }

  private:
    enum class Shape { plane, cylinder, half_cylinder };
    Shape shape_;
    glm::dvec3 axis_;
};

}  // namespace raybundle
