// SPDX-License-Identifier: Apache-2.0
// Rooms in which something changes, built without files.
#pragma once

#include "scene/scene.h"

namespace raybundle {

/// Two closed rooms of 4 m side by side, each with a lamp below its ceiling (lamp0, lamp1); an
/// object `hood` that would enclose lamp0 stands far below.
Scene two_rooms();
/// A closed room of 6 m by 6 m with lamp0, an object `thing` of 0.8 m about its own origin, and
/// thirty small boxes thing0 to thing29. Materials: `wall`, Lambert.
Scene furnished_room();
/// The same walls with a metallic-roughness material of roughness 0.5, without furniture.
Scene plastic_room();
/// Two rooms behind one another with an opening of 1.5 m by 2 m between them, lamp0 in the first,
/// a faint lamp1 in the second. Panes for the opening, `clear` and `dark`, stand outside; `lamp`,
/// an object, hangs in the first.
Scene rooms_with_opening();
/// A room with a lamp and an object `mirror`, a sheet of reflectance 0.95 about its own origin.
Scene room_with_mirror();

}  // namespace raybundle
