// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "journal/redis/redis_connection.h"

namespace raybundle {

/// Warns where Redis is not set up to have on disk what it has acknowledged. Throws RedisAway.
void check_durability(RedisConnection& connection);

/// A name that no other server has: 64 random bits.
std::string random_name();

}  // namespace raybundle
