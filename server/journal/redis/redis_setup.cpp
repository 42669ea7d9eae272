// SPDX-License-Identifier: Apache-2.0
#include "journal/redis/redis_setup.h"

#include <spdlog/spdlog.h>

#include <random>
#include <string_view>
#include <utility>

namespace raybundle {

std::string random_name() {
    std::random_device random;
    constexpr std::string_view digits = "0123456789abcdef";
    std::string name;
    for (int i = 0; i < 16; ++i) {
        name += digits[random() % digits.size()];
    }
    return name;
}

void check_durability(RedisConnection& connection) {
    for (const auto& [key, wanted] :
         {std::pair("appendonly", "yes"), std::pair("appendfsync", "always")}) {
        try {
            const RedisReply reply = connection.command({"CONFIG", "GET", key});
            if (reply.list.size() == 2 && reply.list[1].text != wanted) {
                spdlog::warn(
                    "Redis has {} {}: changes that were acknowledged may be lost with it; "
                    "set it to {}",
                    key, reply.list[1].text, wanted);
            }
        } catch (const RedisRefusal&) {
            return;  // the user may not ask
        }
    }
}

}  // namespace raybundle
