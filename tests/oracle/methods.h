// SPDX-License-Identifier: Apache-2.0
// The ways to solve a scene that a proof goes through, one after the other.
#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "oracle/oracles.h"
#include "oracle/scene_builder.h"

namespace raybundle {

/// Ray bundles with some mix of strategies, or single rays.
struct Method {
    std::string name;
    std::optional<StrategyProbabilities> bundles;  ///< nothing: single rays

    /// Whether it is one strategy by itself.
    [[nodiscard]] bool alone() const {
        return bundles &&
               (bundles->layered == 1.0F || bundles->plane == 1.0F || bundles->perspective == 1.0F);
    }
};

const Method& layered();
const Method& plane();
const Method& perspective();
const Method& combined();          ///< as the solver comes
const Method& three_strategies();  ///< 0.15, 0.15, 0.7
const Method& single_ray();

/// For names of tests.
inline void PrintTo(const Method& method, std::ostream* out) {
    *out << method.name;
}

/// Mean irradiance per patch, lx, first channel; ray bundles need a GL context. Probabilities of
/// the settings do not count; single rays take 256 times as many particles as there are iterations.
std::vector<double> irradiance_by(const Method& method, const Scene& scene, const PatchMesh& mesh,
                                  const OracleSettings& settings);
std::vector<double> irradiance_by(const Method& method, const SceneBuilder& builder,
                                  const OracleSettings& settings);

/// Area mean over the patches that `wanted` names by their index.
double area_mean(const PatchMesh& mesh, const std::vector<double>& values,
                 const std::function<bool(std::size_t)>& wanted);
/// The same over patches [first, last).
double area_mean(const PatchMesh& mesh, const std::vector<double>& values, std::size_t first,
                 std::size_t last);

}  // namespace raybundle
