// SPDX-License-Identifier: Apache-2.0
// The angles at which reflectance is tabulated.
#pragma once

#include <algorithm>
#include <cmath>

namespace raybundle {

/// Nodes of a table over the cosine of an angle, from grazing (node 0) to normal incidence.
constexpr int reflectance_nodes = 80;

/// Scale of the cosine below which shadowing changes a lobe of width `alpha`.
inline float grazing_scale(float alpha) {
    return alpha / (1.0F + 3.0F * alpha);
}

/// Position of a cosine among the nodes, 0..reflectance_nodes - 1. Some nodes resolve cosines near
/// `q` = grazing_scale(), others Fresnel's (1 - cos)^5, and the rest are even in the angle near
/// normal incidence, where a rough lobe's importance has a kink. brdf.glsl has the same formula.
inline float node_of_cosine(float cosine, float q) {
    const float c = std::clamp(cosine, 0.0F, 1.0F);
    const float shadowing = c * (1.0F + q) / (c + q);
    const float fresnel = c * (2.0F - c);
    const float normal = 1.0F - std::sqrt(1.0F - c);
    return (0.3F * shadowing + 0.2F * fresnel + 0.5F * normal) *
           static_cast<float>(reflectance_nodes - 1);
}

/// The inverse of node_of_cosine().
float cosine_of_node(float node, float q);

}  // namespace raybundle
