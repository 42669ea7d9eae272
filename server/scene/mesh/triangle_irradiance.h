// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace raybundle {

/// Irradiance of a surface at a point, of a unit normal, by a triangle of radiance 1 that sends to
/// both sides and is hidden by nothing: pi times the share of the hemisphere, projected, that it
/// fills. Lambert's formula (J. H. Lambert 1760, "Photometria"): half the sum over the edges of the
/// angle that one fills and the cosine of its plane's normal, below the horizon cut off (D. Baum,
/// H. Rushmeier, J. Winget 1989, "Improving Radiosity Solutions Through the Use of Analytically
/// Determined Form-Factors").
double triangle_irradiance(const std::array<glm::dvec3, 3>& corners, const glm::dvec3& point,
                           const glm::dvec3& normal);

}  // namespace raybundle
