// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace raybundle {

constexpr double min_colour_temperature = 1000.0;   ///< K
constexpr double max_colour_temperature = 25000.0;  ///< K, where CIE's daylight ends

/// Linear Rec. 709 of luminance 1, without negative parts, of white light of a correlated colour
/// temperature (K): of a black body below 5000 K, of CIE daylight from there on, as CIE 13.3
/// chooses its reference.
glm::vec3 colour_of_temperature(double kelvin);

}  // namespace raybundle
