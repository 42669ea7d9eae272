// SPDX-License-Identifier: Apache-2.0
#include "scene/material/reflectance_nodes.h"

namespace raybundle {

float cosine_of_node(float node, float q) {
    // Monotone without a closed inverse: bisection, until float tells the bounds apart no more.
    float low = 0.0F;
    float high = 1.0F;
    for (int step = 0; step < 64; ++step) {
        const float middle = 0.5F * (low + high);
        if (middle <= low || middle >= high) {
            break;
        }
        (node_of_cosine(middle, q) < node ? low : high) = middle;
    }
    return high;
}

}  // namespace raybundle
