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
/// each: in the first so many times as much. Known: the mean of the second, Phi/(S(1 - rho)).
KnownScene bright_and_dim_room(float ratio);

/// An emitting unit square that meets a black one at a right angle, 8 x 8 cells each. Known: every
/// patch along the common edge, by the factor of Lambert's polygon formula.
KnownScene corner();

/// A hall of 100 x 4 x 4 m that emits everywhere and is black; 10 cm above its floor a black square
/// of 20 cm that consists of triangles of 1 mm. Known: the mean over them, pi Le.
KnownScene hall_with_small_patches();

/// A cube of 4 m that emits everywhere and is black, with 200 loose black slivers in it: 1 m long,
/// 0.3 mm wide, every which way. Known: the mean over them, pi Le. In a window of 64 pixels the
/// rasteriser turns many of them over, and counts 6.6 % more area than they have.
KnownScene room_with_slivers();

/// Two cubes of 4 m, black; one emits everywhere, of the other the wall between them consists of
/// strips of 4 m times 4 m / strips.
struct StripedWall {
    SceneBuilder builder;
    std::size_t first_dark = 0;  ///< patch of the dark room
};
StripedWall striped_wall(float thickness, std::uint32_t strips);

}  // namespace raybundle
