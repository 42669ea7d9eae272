// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace raybundle {

/// Whether a value is larger than another by more than rounding explains, so that what is equal but
/// for the scale and the place of the scene is decided alike.
template <typename T>
bool clearly_more(T value, T other) {
    constexpr T rounding = T(1e-3);
    return value > other + rounding * std::abs(other);
}

}  // namespace raybundle
