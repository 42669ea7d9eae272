// SPDX-License-Identifier: Apache-2.0
#include "ball.h"

#include <cmath>
#include <numbers>

namespace raybundle {

void add_ball(SceneBuilder& b, const glm::vec3& centre, float radius, int n,
              std::uint32_t material) {
    const auto at = [&](int i, int j) {
        const float polar =
            std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(n);
        const float round =
            std::numbers::pi_v<float> * static_cast<float>(j) / static_cast<float>(n);
        return centre + radius * glm::vec3(std::sin(polar) * std::cos(round), std::cos(polar),
                                           std::sin(polar) * std::sin(round));
    };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < 2 * n; ++j) {
            if (i + 1 < n) {
                b.add_triangle(at(i, j), at(i + 1, j + 1), at(i + 1, j), material);
            }
            if (i > 0) {
                b.add_triangle(at(i, j), at(i, j + 1), at(i + 1, j + 1), material);
            }
        }
    }
}

}  // namespace raybundle
