// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "bundle/hemicube.h"

namespace raybundle {

/// Per face of a hemicube one over the probability that it is drawn with, 0 where it is not.
using FaceWeights = std::array<float, Hemicube::face_count>;

constexpr FaceWeights all_faces = {1.0F, 1.0F, 1.0F, 1.0F, 1.0F};

/// Randomised hemicube of a specular shooter (ch. 5.2, 5.3): faces are drawn with probabilities
/// that follow the power that leaves through them, and carry that much more where they are drawn.
/// lobe: bundle coordinates, main direction of what is reflected specularly; lobe_share: of all
/// power, 0..1; u in [0, 1) decides. One number for all faces (systematic sampling): how many are
/// drawn hardly varies.
FaceWeights choose_faces(const glm::vec3& lobe, float lobe_share, float u);

}  // namespace raybundle
