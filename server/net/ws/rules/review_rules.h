// SPDX-License-Identifier: Apache-2.0
// What reviewers may leave for each other: pins, viewpoints.
#pragma once

#include "net/ws/rules/message_checker.h"

namespace raybundle {

void check_body(const v1::AddPin& pin, MessageChecker& check);
void check_body(const v1::RemovePin& pin, MessageChecker& check);
void check_body(const v1::SaveViewpoint& viewpoint, MessageChecker& check);
void check_body(const v1::RemoveViewpoint& viewpoint, MessageChecker& check);
void check_body(const v1::PointAt& point, MessageChecker& check);
void check_body(const v1::ReplyToPin& reply, MessageChecker& check);
void check_body(const v1::SetPin& pin, MessageChecker& check);

}  // namespace raybundle
