// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <string>

namespace raybundle {

/// Air that absorbs and scatters, alike everywhere in the box that holds the scene
/// (Scene::bounds); beyond it there is none. Colours differ by the albedo alone.
struct Medium {
    double extinction = 0.0;  ///< 1/m, absorption and scattering together
    glm::vec3 albedo{1.0F};   ///< share of it that is scattered, 0..1
    double anisotropy = 0.0;  ///< g of Henyey and Greenstein 1941: mean cosine of the deflection

    static constexpr double least_visibility = 0.1;  ///< m
    static constexpr double most_visibility = 1e6;
    static constexpr double most_anisotropy = 0.9;

    /// Air in which black things fade against the horizon to a contrast of 2 % at that distance, m
    /// (Koschmieder 1924): extinction ln(50) / visibility.
    static double extinction_of(double visibility);
    [[nodiscard]] double visibility() const;  ///< m
    /// What is left of light after so many metres.
    [[nodiscard]] double left_after(double metres) const;
};

/// Density of a deflection, 1/sr, by its cosine (1: straight on).
double phase_of(double anisotropy, double cosine);
/// A direction with that density. along: unit, of the light. u: uniform in [0, 1).
glm::dvec3 scattered_direction(double anisotropy, const glm::dvec3& along, const glm::dvec2& u);

/// The part of a ray within a box: from `begin` to `end` metres along a unit direction; empty where
/// begin >= end. end: how far the ray goes at most.
struct WayInBox {
    double begin = 0.0, end = 0.0;
    [[nodiscard]] double length() const { return end > begin ? end - begin : 0.0; }
};
WayInBox way_in_box(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& origin,
                    const glm::dvec3& direction, double end);

/// The problem with a medium's numbers, as "visibility: must be ...", empty where there is none.
std::string problem_of(const Medium& medium);

}  // namespace raybundle
