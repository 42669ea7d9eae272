// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string_view>

namespace raybundle {

/// For EXPECT_PRED_FORMAT2: equal as JSON values; the order of an object's members means nothing.
inline testing::AssertionResult SameJson(const char* /*a_text*/, const char* /*b_text*/,
                                         std::string_view a, std::string_view b) {
    const auto parsed_a = nlohmann::json::parse(a, nullptr, false);
    const auto parsed_b = nlohmann::json::parse(b, nullptr, false);
    if (!parsed_a.is_discarded() && parsed_a == parsed_b) {
        return testing::AssertionSuccess();
    }
    return testing::AssertionFailure() << a << "\ndiffers from\n" << b;
}

}  // namespace raybundle
