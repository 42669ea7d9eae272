// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/scene.h"
#include "scene/walk/world_rays.h"

namespace raybundle {

/// Height of the eyes of somebody who stands, m.
constexpr float eye_height = 1.6F;

/// Views of somebody who stands inside: eyes at eye_height above an even floor with room for a
/// person, a ceiling above and walls around, where light of a lamp or the sky comes; each looks
/// along the longest line of its surroundings. The best first, at most `most`, no two of which see
/// one another or stand within 2 m. Where most ceilings are more than 50 m above, the file is in
/// another unit: these lengths are then those of rooms 2.5 m high. Empty where the scene has no
/// such place.
std::vector<Camera> standing_views(const Scene& scene, const WorldRays& rays, std::size_t most);

}  // namespace raybundle
