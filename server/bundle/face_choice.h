// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "bundle/hemicube.h"

namespace raybundle {

/// Per face of a hemicube one over the probability that it is drawn with, 0 where it is not.
using FaceWeights = std::array<float, Hemicube::face_count>;

constexpr FaceWeights all_faces = {1.0F, 1.0F, 1.0F, 1.0F, 1.0F};

/// Randomised hemicube of a specular shooter (ch. 5.2, 5.3): a face is drawn with a probability
/// that follows the power through it, and its light is divided by that probability.
/// lobe: main direction of specular reflection, bundle coordinates; lobe_share: its share of all
/// power, 0..1; u in [0, 1) decides. All faces use one number (systematic sampling), so that the
/// number of faces drawn hardly varies.
FaceWeights choose_faces(const glm::vec3& lobe, float lobe_share, float u);

}  // namespace raybundle
