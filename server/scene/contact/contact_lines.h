// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/scene.h"

namespace raybundle {

/// A line on a triangle along which another surface stands on it or goes through it, or nearly so,
/// for most of the way across: the foot of a wall on a floor that runs on beneath, a window frame
/// on a reveal. Light ends at such a line. A patch that reached across it would carry the light of
/// one side to the other (the "light leaks" of radiosity; Baum et al. 1991, "Making Radiosity
/// Usable", and Heckbert 1992, "Discontinuity Meshing for Radiosity", whose D0 lines these are).
struct ContactLine {
    std::uint32_t triangle = 0;  ///< of Scene::triangles
    glm::dvec3 normal{0.0};      ///< world, unit, in the triangle's plane and square to the line
    double offset = 0.0;         ///< m: dot(normal, x) on the line

    /// Signed distance from the line of a point of the triangle, m.
    [[nodiscard]] double distance(const glm::dvec3& point) const {
        return glm::dot(normal, point) - offset;
    }
};

/// Lines closer together than this, or to a corner, are one (share of a patch's edge).
constexpr double contact_resolution = 0.125;

/// Contact lines, at the objects' initial places, that matter to patches with edges of this length
/// (m): surfaces up to a twentieth of it apart count as touching. Sorted by triangle, the longest
/// first; at most `max_contact_lines` each.
constexpr std::size_t max_contact_lines = 8;
std::vector<ContactLine> find_contact_lines(const Scene& scene, double patch_edge);

}  // namespace raybundle
