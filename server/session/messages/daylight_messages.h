// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "raybundle.pb.h"
#include "scene/scene.h"

namespace raybundle {

/// Of a message that has been resolved().
DaylightSetting from_message(const v1::SetDaylight& daylight);

/// The same change with all that it means: sky, place, north and time as they are where it does not
/// say, and the sun's angles that follow from them.
v1::SetDaylight resolved(const Scene& scene, const v1::SetDaylight& daylight);

/// Why a change cannot be made of this scene, with the field; empty where it can.
std::string problem_of(const Scene& scene, const v1::SetDaylight& daylight);

/// As it is now.
v1::SetDaylight state_of_daylight(const Scene& scene);

/// Adds the scene's lights from the first of the sky on.
void describe_sky_lights(const Scene& scene, v1::SetDaylight* message);

}  // namespace raybundle
