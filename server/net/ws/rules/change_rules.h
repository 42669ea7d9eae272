// SPDX-License-Identifier: Apache-2.0
// What editors may say of the scene: things, light, materials, daylight, animations, which one it
// is.
#pragma once

#include "net/ws/rules/message_checker.h"

namespace raybundle {

constexpr float max_fade_seconds = 60.0F;  ///< of SetLight, SetGroup and ApplyLightingScene

void check_body(const v1::MoveObject& move, MessageChecker& check);
void check_body(const v1::SetLight& light, MessageChecker& check);
void check_body(const v1::AddObject& object, MessageChecker& check);
void check_body(const v1::RemoveObject& object, MessageChecker& check);
void check_body(const v1::AddLuminaire& luminaire, MessageChecker& check);
void check_body(const v1::RemoveLight& light, MessageChecker& check);
void check_body(const v1::SetGroup& group, MessageChecker& check);
void check_body(const v1::SetDaylight& daylight, MessageChecker& check);
void check_body(const v1::SaveLightingScene& scene, MessageChecker& check);
void check_body(const v1::ApplyLightingScene& scene, MessageChecker& check);
void check_body(const v1::RemoveLightingScene& scene, MessageChecker& check);
void check_body(const v1::PlayAnimation& play, MessageChecker& check);
void check_body(const v1::SetMaterial& material, MessageChecker& check);
void check_body(const v1::OpenScene& open, MessageChecker& check);

}  // namespace raybundle
