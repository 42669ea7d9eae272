// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace raybundle {

/// Finds doubleSided surfaces that are the outside of something solid, and marks their triangles
/// (Triangle::solid): modellers write doubleSided for everything, and nobody will ever see the
/// inside of a table's leg. Simulating it costs half of the patches, and of a lamp it would be a
/// furnace that holds 1/(1 - albedo) times the light that the room has.
///
/// A solid is closed (each of its edges joins two triangles, in opposite directions), opaque,
/// turned outwards, and has nothing within: no camera, no lamp of KHR_lights_punctual and no other
/// surface as a whole. So a room that is one doubleSided box keeps its inside, whichever way it is
/// turned. Surfaces that go through it do not count: walls overlap at their corners.
///
/// Returns the number of triangles marked. `scene.cameras` must be known.
std::size_t mark_solid_shells(Scene& scene);

/// A lamp of which no light gets out.
struct EnclosedLight {
    std::string light;   ///< name of the punctual light, or of the material that emits
    std::string object;  ///< whose surface encloses it
};

/// Lamps within closed, opaque surfaces that hold no camera: bulbs in shades that were modelled
/// without glass. Looks no further where that would take too long. `scene.cameras` must be known.
std::vector<EnclosedLight> find_enclosed_lights(const Scene& scene);

/// Makes thin panes of glass bodies (KHR_materials_volume) all of whose surfaces are sheets: light
/// would go into them and never out again. Their thickness is below 0 then, and what it absorbs
/// tints them (specular_surface()). A sheet has an edge, and its area as a vector, which is 0 of
/// whatever closes, is not; another sheet of the object at about the thickness closes it, too: two
/// faces of a pane without its rims. Returns the names of these materials.
std::vector<std::string> thin_open_glass(Scene& scene);

}  // namespace raybundle
