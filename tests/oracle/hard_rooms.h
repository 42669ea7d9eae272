// SPDX-License-Identifier: Apache-2.0
// Scenes of numerics.md that are hard to get right, with what is exactly known of them.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "oracle/scene_builder.h"

namespace raybundle {

/// Patches [first, last) and the mean irradiance, lx, that they have in closed form.
struct KnownPatches {
    std::size_t first = 0;
    std::size_t last = 0;
    double irradiance = 0.0;
};

struct KnownScene {
    SceneBuilder builder;
    std::vector<KnownPatches> known;
};

/// Two facing plates, 100 times wider than their gap of 1 m, both emitting, albedos 0.5 and 0.8.
/// The middle 60 x 60 m of each come first: the rims, 20 gaps away, take less than 0.2 % from them.
/// B1 = (E1 + rho1 E2)/(1 - rho1 rho2).
KnownScene parallel_plates();

/// Two facing unit squares, d m apart; one emits.
KnownScene unit_squares(double distance);

/// A closed room of any shape that emits everywhere: one furnace.
KnownScene tetrahedron_furnace(float albedo);
KnownScene sphere_furnace(float albedo);

/// Two closed 4 m cubes of albedo 0.5, 0.1 m apart, with one square metre of ceiling that emits in
/// each: in the first a million times as much. Known: the mean of the second, Phi/(S(1 - rho)).
KnownScene bright_and_dim_room();

/// An emitting unit square that meets a black one at a right angle, 8 x 8 cells each. Known: every
/// patch along the common edge, by the factor of Lambert's polygon formula.
KnownScene corner();

/// A hall of 100 x 4 x 4 m that emits everywhere and is black; scattered over its floor, 10 cm
/// above it, 100 000 black squares of 1 mm. Known: the mean over the squares, pi Le.
KnownScene hall_with_small_patches();

}  // namespace raybundle
