// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

namespace raybundle {

/// Linear Rec. 709 of CIE XYZ whose white is D65: (0.9505, 1, 1.089) becomes (1, 1, 1).
glm::dmat3 rec709_from_xyz();

/// Linear Rec. 709 of an RGB space with these chromaticities: x, y of red, green, blue and white.
/// White stays white: that of D65 takes the place of the space's own. Nothing where they make no
/// space.
std::optional<glm::dmat3> rec709_from_primaries(const std::array<double, 8>& xy);

}  // namespace raybundle
