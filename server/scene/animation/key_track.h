// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <vector>

namespace raybundle {

/// How glTF 2.0 (3.11, appendix C) goes from one key to the next.
enum class Interpolation { linear, step, cubic_spline };

/// A value over time: at least one key, times in s that grow, all numbers finite. Before the first
/// key and behind the last it is that key's.
struct KeyTrack {
    Interpolation interpolation = Interpolation::linear;
    std::size_t components = 1;  ///< 1 to 4, of morph weights any number
    std::vector<float> times;
    /// components of each key, in order; of a cubic spline in-tangent, value, out-tangent.
    std::vector<float> values;

    /// Component by component, of at most four; 0 where there are fewer.
    [[nodiscard]] glm::vec4 at(double seconds) const;
    /// One of any number of components.
    [[nodiscard]] float component_at(double seconds, std::size_t component) const;
    /// Of a track of four components that are x, y, z, w: unit, on the shorter way.
    [[nodiscard]] glm::quat rotation_at(double seconds) const;

  private:
    struct Span {
        std::size_t before = 0, after = 0;  ///< keys; the same outside of all
        double length = 0.0;                ///< s
        float share = 0.0F;                 ///< of the way from one to the other, 0..1
    };
    [[nodiscard]] Span span_at(double seconds) const;
    /// part: of a cubic spline 0 for the in-tangent, 1 the value, 2 the out-tangent.
    [[nodiscard]] float number(std::size_t index, std::size_t part, std::size_t component) const;
};

}  // namespace raybundle
