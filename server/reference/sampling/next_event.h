// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

#include "reference/sampling/light_sampling.h"
#include "reference/sampling/random.h"
#include "reference/scattering.h"

namespace raybundle {

/// What thin panes of glass do to shadow rays of punctual lights.
enum class Panes { block, pass };

/// Next-event estimation: one sample of the light that comes straight from lights and that a point
/// reflects, cd/m², 0 where none arrives. lobe_samples: how many directions of the lobe (after
/// Scattering::sample()) look for the same light per sample of this; both are weighted by the power
/// heuristic. 0: none.
[[nodiscard]] glm::dvec3 next_event(const LightSampling& lights, const SurfacePoint& point,
                                    const Scattering& scattering, double lobe_samples,
                                    Sampler& sampler, Panes panes = Panes::block);

}  // namespace raybundle
