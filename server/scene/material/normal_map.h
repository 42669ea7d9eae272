// SPDX-License-Identifier: Apache-2.0
// Normal maps of glTF 2.0 (3.9.3). The tangent frame is the triangle's own: x along the direction
// in which u grows, y against the one in which v grows, so that it points up in the image. It is
// made orthogonal to the interpolated normal, and mirrored where the image is. Vertex tangents of a
// file, which are this frame averaged over neighbours, are not used.
// shaders/material/material_details.glsl has the same formulas.
#pragma once

#include <array>
#include <glm/glm.hpp>

namespace raybundle {

/// Cosine between normal and view at least. A map may bend normals away from the eye; what such a
/// surface reflects is not defined, so they are turned back to here.
constexpr double least_view_cosine = 0.02;

/// z of a map's normal at least: maps know no overhangs.
constexpr double least_map_height = 1e-3;

/// One triangle: edges from corner 0 to 1 and 2, and how uv (after the slot's transform) changes
/// along them.
struct TangentEdges {
    glm::dvec3 edge1{0.0}, edge2{0.0};
    glm::dvec2 uv1{0.0}, uv2{0.0};
};

/// Normal of a front side, unit. normal: before the map, unit, on that side; texel: of the map, 0
/// to 1. The normal itself where uv are degenerate.
glm::dvec3 mapped_normal(const TangentEdges& triangle, const glm::dvec3& normal,
                         const glm::dvec3& texel, double scale);

/// The normal, turned towards the viewer where it faces away; to_eye: unit.
glm::dvec3 facing_normal(const glm::dvec3& normal, const glm::dvec3& to_eye);

}  // namespace raybundle
