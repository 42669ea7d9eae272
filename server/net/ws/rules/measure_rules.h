// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "net/ws/rules/message_checker.h"

namespace raybundle {

/// What a request to measure points in the air may say.
void check_measure(const v1::Measure& measure, MessageChecker& check);
void check_zone(const v1::SetZone& zone, MessageChecker& check);
/// What a requirement of zones may say.
void check_requirement(const v1::SetRequirement& set, MessageChecker& check);

}  // namespace raybundle
