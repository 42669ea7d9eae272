// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <stop_token>
#include <string>

namespace raybundle {

/// Prints a document of HTML as PDF by Chromium, where it is installed. Takes some seconds.
/// Nothing and a reason for people where that does not work. Who asks for it to stop gets nothing
/// soon: the program is ended.
std::optional<std::string> print_pdf(const std::string& html, std::string& reason,
                                     const std::stop_token& stop = {});

/// Path of an installed Chromium; empty: there is none.
std::string find_browser();

}  // namespace raybundle
