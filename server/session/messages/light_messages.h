// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "raybundle.pb.h"
#include "scene/edit/light_edit.h"
#include "scene/scene.h"

namespace raybundle {

/// Of a message that has been resolved().
LightEdit from_message(const v1::SetLight& light);

/// The same change by what a light is made of: intensity in its own unit instead of flux, colour
/// instead of a temperature.
v1::SetLight resolved(const Scene& scene, const v1::SetLight& light);

/// Why a change cannot be made of this scene, with the field; empty where it can.
std::string problem_of(const Scene& scene, const v1::SetLight& light);

/// All that can be changed of a light, as it is now. id: a number without problem.
v1::SetLight state_of_light(const Scene& scene, std::uint32_t id);

/// What `welcome` says of the lights.
void describe_lights(const Scene& scene, v1::Scene* message);

}  // namespace raybundle
