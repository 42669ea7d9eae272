// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "net/ws/rules/message_checker.h"

namespace raybundle {

/// What requests to add something to the scene may say.
void check_addition(const v1::AddObject& object, MessageChecker& check);
void check_addition(const v1::AddLuminaire& luminaire, MessageChecker& check);
/// name: of the field, for complaints.
void check_transform(const v1::Transform& transform, const std::string& name,
                     MessageChecker& check);

}  // namespace raybundle
