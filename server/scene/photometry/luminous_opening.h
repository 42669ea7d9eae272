// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "scene/photometry/ies_profile.h"

namespace raybundle {

/// The flat area that a light with a photometric file shines from: every point of it sends the same
/// share of the file's intensities (the EDF of ch. 2.2.3, L = I / (A cos)). In the plane x, y of
/// the light's axes.
struct LuminousOpening {
    enum class Shape {
        point,
        rectangle,
        ellipse,
        quarter  ///< of an ellipse, which `half` points into
    };
    static constexpr unsigned parts = 4;

    Shape shape = Shape::point;
    glm::dvec2 middle{0.0};  ///< from the light's position, m; of a quarter: the ellipse's
    glm::dvec2 half{0.0};    ///< half its sizes, m; of a quarter negative towards -x and -y
    double steepness = 1.0;  ///< IesProfile::steepness()

    /// Draws points evenly over its area, m from the light's position. u: in [0, 1]².
    [[nodiscard]] glm::dvec2 at(const glm::dvec2& u) const;
    /// How far its light may be taken for that of its middle: distances are compared with this, m.
    [[nodiscard]] double reach() const { return steepness * largest_half(); }
    [[nodiscard]] double largest_half() const;
};

/// What the file states, round the light's position; a point where there is no file or no size.
LuminousOpening opening_of(const IesProfile* profile);

/// A place of an opening (LuminousOpening::at()) and its share.
struct OpeningPoint {
    glm::dvec2 u{0.5};
    double weight = 1.0;
};

/// Gauss-Legendre quadrature over an opening, of an ellipse in the squares of its radii and evenly
/// round it: for a Lambert surface's light at a distance (m) within a relative error, by the bound
/// that shaders/solution/opening.glsl derives. 16 points at least, so that those who see a part of
/// it alone are found.
std::vector<OpeningPoint> opening_points(const LuminousOpening& opening, double distance,
                                         double tolerance);

/// A quarter of an opening, which shadows take for a point: four of these lie at four different
/// places along each side, so that the shadow of a straight edge has four steps, and their second
/// moments are those of the whole within 6 %.
struct OpeningPart {
    glm::dvec2 seen_from{0.0};  ///< place that shadows are cast from, m from the whole's middle
    LuminousOpening opening;    ///< about that place
};
OpeningPart part_of(const LuminousOpening& whole, unsigned part);

}  // namespace raybundle
