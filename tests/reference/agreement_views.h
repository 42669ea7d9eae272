// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "oracle/scene_builder.h"

namespace raybundle {

/// A small scene of an agreement test and where it is looked at from.
struct View {
    SceneBuilder builder;
    Camera camera;
    int effort = 1;  ///< factor of the samples that it needs
};

/// 0: a furnished room; 1 to 3: light by a glossy floor alone, of each of glossy_materials();
/// 4: punctual lights, sky and sun; 5: a mirror, a pane and a body of glass in a room; 6: caustics
/// of a body of glass and a mirror; 7: the same of surfaces whose normals lean;
/// 8: a block inside of glass.
View agreement_view(int index);

}  // namespace raybundle
