// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace raybundle {

/// Share of the way to another exposure that a frame goes which comes so many seconds after the one
/// before: 15 % at 20 frames a second and more; where frames come less often, as far as those that
/// are missing would have gone.
inline float exposure_follow(double since_frame_s) {
    constexpr double frames_per_second = 20.0;
    return static_cast<float>(1.0 -
                              std::pow(0.85, std::max(since_frame_s * frames_per_second, 1.0)));
}

/// EV of a viewer's frames.
class ShownExposure {
  public:
    /// Somebody has set it: the next frame has it at once. A picture whose own brightness is not
    /// known by then is as bright as the last one, but for what was set.
    void set(float stops) {
        if (ev_) {
            *ev_ += stops;
        }
        jumps_ = true;
    }

    /// wanted: of the picture; empty as long as its brightness is not known.
    float next(std::optional<float> wanted, double since_frame_s) {
        if (wanted) {
            const float follow = ev_ && !jumps_ ? exposure_follow(since_frame_s) : 1.0F;
            const float before = ev_.value_or(*wanted);
            ev_ = before + (*wanted - before) * follow;
            jumps_ = false;
        }
        return ev_.value_or(0.0F);
    }

    /// Empty: nothing has been shown, or something else has been set since.
    [[nodiscard]] std::optional<float> ev() const { return jumps_ ? std::nullopt : ev_; }
    /// Likewise, but for what has been set since.
    [[nodiscard]] std::optional<float> last() const { return ev_; }

  private:
    std::optional<float> ev_;
    bool jumps_ = false;
};

}  // namespace raybundle
