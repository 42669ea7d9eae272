// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace raybundle {

/// Probabilities of the strategies (ch. 6.2): the densities of all receivers use the same numbers.
struct StrategyProbabilities {
    float layered = 0.3F;      ///< P1
    float plane = 0.0F;        ///< P2
    float perspective = 0.7F;  ///< P3
    float opening = 0.0F;      ///< of bundles that start in openings to the sky
};

}  // namespace raybundle
