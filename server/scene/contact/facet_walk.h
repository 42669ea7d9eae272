// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/contact/facet_tree.h"

namespace raybundle {

/// Triangle of a facet at a point, as the shaders find it. node: the facet's own; weights: the
/// barycentric weights of the facet's corners there.
std::uint32_t triangle_at(FacetNode node, const std::vector<FacetNode>& tree, glm::vec3 weights);

}  // namespace raybundle
