// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace raybundle {

/// What is wrong with a page of metrics: the Prometheus text format 0.0.4 and the rules of
/// `promtool check metrics`. Empty: nothing.
std::vector<std::string> metrics_problems(std::string_view text);

}  // namespace raybundle
