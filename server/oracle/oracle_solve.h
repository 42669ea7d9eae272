// SPDX-License-Identifier: Apache-2.0
// What all oracles do: solve a small scene, average over patches.
#pragma once

#include <vector>

#include "oracle/oracles.h"
#include "oracle/scene_builder.h"
#include "transport/solver.h"

namespace raybundle {

/// Nothing axis-aligned passes by luck.
glm::mat4 odd_rotation();

Solver solve(const Scene& scene, const PatchMesh& mesh, const OracleSettings& settings);
Solver solve(const SceneBuilder& builder, const OracleSettings& settings);

/// Area mean of the irradiance (first channel) over patches [first, last).
double mean_irradiance(const SceneBuilder& builder, const std::vector<glm::vec4>& irradiance,
                       std::size_t first, std::size_t last);
double mean_irradiance(const SceneBuilder& builder, const std::vector<glm::vec4>& irradiance);

}  // namespace raybundle
