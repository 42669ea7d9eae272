// SPDX-License-Identifier: Apache-2.0
#include "bundle/face_choice.h"

#include <algorithm>
#include <cmath>

namespace raybundle {

namespace {

/// Shares of a Lambert shooter's power through the top and through a side: the form factor of a
/// square of side 2 at distance 1 from below its centre, 4/(pi sqrt 2) atan(1/sqrt 2), and a
/// quarter of the rest.
constexpr float top_share = 0.5541F;
constexpr float side_share = 0.25F * (1.0F - top_share);
constexpr float certain_share = 0.3F;  // faces with more of the power than this are always drawn
constexpr float least_probability = 0.1F;  // no face weighs more than one over this

int face_of(const glm::vec3& d) {
    const glm::vec3 a = glm::abs(d);
    if (d.z >= std::max(a.x, a.y)) {
        return 0;
    }
    return a.x >= a.y ? (d.x > 0.0F ? 1 : 2) : (d.y > 0.0F ? 3 : 4);
}

}  // namespace

FaceWeights choose_faces(const glm::vec3& lobe, float lobe_share, float u) {
    FaceWeights weights{};
    const int main_face = face_of(lobe);
    float before = u;
    for (int face = 0; face < Hemicube::face_count; ++face) {
        const float power = (1.0F - lobe_share) * (face == 0 ? top_share : side_share) +
                            (face == main_face ? lobe_share : 0.0F);
        const float probability = std::clamp(power / certain_share, least_probability, 1.0F);
        const float after = before + probability;
        if (std::floor(after) > std::floor(before)) {
            weights[static_cast<std::size_t>(face)] = 1.0F / probability;
        }
        before = after;
    }
    return weights;
}

}  // namespace raybundle
