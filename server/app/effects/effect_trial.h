// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"

namespace raybundle {

/// A scene that effects are taken out of, to see what they do and cost.
struct EffectTrial {
    Scene scene;
    PatchMesh mesh;
    bool caustics = true;

    /// Takes one out, by its name in the effects plan. False where that is not possible, as for
    /// `diffuse`.
    bool remove(std::string_view effect);
};

struct TrialLength {
    glm::uvec2 size;       ///< of the one viewer, pixels
    int first_iterations;  ///< in which drivers finish compiling: not timed
    int iterations;        ///< after them
};

struct TrialOutcome {
    double ms = 0.0;                  ///< per iteration, viewer included
    std::size_t bytes = 0;            ///< of GPU memory, viewer included
    std::vector<glm::dvec3> picture;  ///< by the scene's first camera, row by row, cd/m²
};

/// Needs a GL context. Throws GpuError.
TrialOutcome run_trial(const EffectTrial& trial, const TrialLength& length, std::uint64_t seed);

}  // namespace raybundle
