// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace raybundle {

/// Share of the way to another exposure that a frame goes which comes so many seconds after the one
/// before: 15 % at 20 frames a second and more; where frames come less often, as far as those that
/// are missing would have gone.
inline float exposure_follow(double since_frame_s) {
    constexpr double frames_per_second = 20.0;
    return static_cast<float>(1.0 -
                              std::pow(0.85, std::max(since_frame_s * frames_per_second, 1.0)));
}

}  // namespace raybundle
