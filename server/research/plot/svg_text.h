// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace raybundle {

/// Text as it may stand between tags and in quoted attributes of XML and HTML. Control characters
/// that XML 1.0 forbids become U+FFFD, and so do bytes that are not UTF-8.
std::string xml_escaped(std::string_view text);

/// A length in pixels for SVG: at most two decimals. Requires a finite number.
std::string svg_number(double value);

/// A number for people: up to three significant digits, no exponent from 1e-4 to 1e6.
std::string readable_number(double value);

}  // namespace raybundle
