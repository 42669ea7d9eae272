// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <glm/glm.hpp>

#include "scene/material/brdf.h"

namespace raybundle::test {

/// Integral over the sphere of g(w) dw, for g that may be peaked as `lobe` is for w_in (in the
/// plane y = 0), and is otherwise at most of the order of the cosine. Two grids of points x points
/// directions, one even in cos dw, one in the distribution of the GGX normals or in cos^n. Shares
/// nothing with the quadrature and the sampling that it tests.
glm::dvec3 integrate(const SpecularLobe& lobe, const glm::vec3& w_in,
                     const std::function<glm::dvec3(const glm::vec3&)>& g, int points = 256);

/// The directional albedo of a BRDF.
glm::dvec3 albedo_by_quadrature(const Brdf& brdf, float cosine, int points = 256);

/// S of scene/material/reflectance_table.h.
double importance_by_quadrature(const Brdf& brdf, float cosine, int points = 256);

/// The unit vector in the plane y = 0 at an angle to the normal.
glm::vec3 direction_in_plane(float cosine);

}  // namespace raybundle::test
