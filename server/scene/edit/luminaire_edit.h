// SPDX-License-Identifier: Apache-2.0
// Luminaires that are added, exchanged and removed while a scene is being shown.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "scene/scene.h"

namespace raybundle {

/// Lights that may be added to a scene: each is a number, a row of the journal and, above
/// PunctualLight::most_mapped, rays.
constexpr std::size_t max_added_lights = 4096;

/// Why a luminaire cannot be added; empty where it can. Its number does not matter.
std::string problem_of(const Scene& scene, const AddedLuminaire& luminaire);
/// Adds one without problem, or brings the one of this number back that has been removed.
void add_luminaire(Scene& scene, const AddedLuminaire& luminaire);
/// Number of the next luminaire that is added.
std::uint32_t next_luminaire(const Scene& scene);
/// How many have been added, those among them that have been removed since: they keep their
/// numbers.
std::size_t added_lights(const Scene& scene);

/// Why a light cannot be removed; empty where it can.
std::string removal_problem(const Scene& scene, std::uint32_t light);
/// Removes a light without problem, or brings it back.
void set_light_removed(Scene& scene, std::uint32_t light, bool removed);

/// Why a light cannot shine by a file of the folder (empty, or the name of its own file: as it was
/// loaded or added); empty where it can.
std::string exchange_problem(const Scene& scene, const PunctualLight& light,
                             const std::string& photometry);
/// Gives a light another distribution and its flux; what else is set of it stays. What it has
/// already it keeps with its intensity.
void exchange_photometry(const Scene& scene, PunctualLight& light, const std::string& photometry);

}  // namespace raybundle
