// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/scene.h"

namespace raybundle {

/// Upper bound of the flux, lm, that comes from lamps (emitting surfaces, punctual lights, suns)
/// and meets a mirror or glass first: what is aimed at the spheres round these, whether anything
/// stands in between or not. Skies do not count. 0 where there are none.
double flux_on_specular_surfaces(const Scene& scene);

/// Flux of a directional light, lm, through the disc round the scene's bounds.
double directional_flux(const Scene& scene, double illuminance);

}  // namespace raybundle
