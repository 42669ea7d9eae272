// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace raybundle {

/// With what is not text in HTML and XML replaced, and without control characters.
std::string escaped(std::string_view text);
/// Three significant digits, no more than four decimals; thousands are not grouped.
std::string three_digits(double value);

/// <table> of a head and rows; cells are HTML.
std::string html_table(const std::vector<std::string>& heads,
                       const std::vector<std::vector<std::string>>& rows);

}  // namespace raybundle
