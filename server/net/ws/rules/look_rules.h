// SPDX-License-Identifier: Apache-2.0
// What viewers may say of how they look at the scene, and ask of what they see.
#pragma once

#include "net/ws/rules/message_checker.h"

namespace raybundle {

void check_body(const v1::Hello& hello, MessageChecker& check);
void check_body(const v1::SetCamera& camera, MessageChecker& check);
void check_body(const v1::GetWalkMap& map, MessageChecker& check);
void check_body(const v1::SetViewport& viewport, MessageChecker& check);
void check_body(const v1::SetTarget& target, MessageChecker& check);
void check_body(const v1::SetDisplay& display, MessageChecker& check);
void check_body(const v1::SetDepths& depths, MessageChecker& check);
void check_body(const v1::Probe& probe, MessageChecker& check);
void check_body(const v1::ProbeGrid& grid, MessageChecker& check);
void check_body(const v1::Ack& ack, MessageChecker& check);
void check_body(const v1::AckLight& ack, MessageChecker& check);
void check_body(const v1::Snapshot& snapshot, MessageChecker& check);

}  // namespace raybundle
