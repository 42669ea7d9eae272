// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace raybundle {

/// A number with so many significant digits, without an exponent from 1e-4 to 1e15: 24 998 lx with
/// four of them is 25000, not 2.5e+04.
std::string significant(double value, int digits);

}  // namespace raybundle
