// SPDX-License-Identifier: Apache-2.0
#include "scene/animation/key_track.h"

#include <algorithm>

namespace raybundle {
namespace {

/// x, y, z, w. What is too short to have a direction is no rotation.
glm::quat unit_quaternion(const glm::vec4& v) {
    const float length = glm::length(v);
    return length > 1e-6F ? glm::quat(v.w / length, v.x / length, v.y / length, v.z / length)
                          : glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
}

}  // namespace

KeyTrack::Span KeyTrack::span_at(double seconds) const {
    const auto later = std::upper_bound(times.begin(), times.end(), seconds,
                                        [](double time, float key) { return time < double{key}; });
    const auto next = static_cast<std::size_t>(later - times.begin());
    if (next == 0 || next == times.size()) {
        const std::size_t end = next == 0 ? 0 : next - 1;
        return {end, end, 0.0, 0.0F};
    }
    const double begun = times[next - 1];
    const double length = double{times[next]} - begun;
    return {next - 1, next, length, static_cast<float>((seconds - begun) / length)};
}

float KeyTrack::number(std::size_t index, std::size_t part, std::size_t component) const {
    const std::size_t parts = interpolation == Interpolation::cubic_spline ? 3 : 1;
    return values[(index * parts + part) * components + component];
}

glm::vec4 KeyTrack::at(double seconds) const {
    glm::vec4 result(0.0F);
    for (std::size_t c = 0; c < std::min<std::size_t>(components, 4); ++c) {
        result[static_cast<int>(c)] = component_at(seconds, c);
    }
    return result;
}

/// A spline as in glTF 2.0, appendix C.5: of Hermite, tangents per second.
float KeyTrack::component_at(double seconds, std::size_t component) const {
    const Span span = span_at(seconds);
    const bool cubic = interpolation == Interpolation::cubic_spline;
    const float before = number(span.before, cubic ? 1 : 0, component);
    if (span.before == span.after || interpolation == Interpolation::step) {
        return before;
    }
    const float after = number(span.after, cubic ? 1 : 0, component);
    const float t = span.share;
    if (!cubic) {
        return glm::mix(before, after, t);
    }
    const float t2 = t * t;
    const float t3 = t2 * t;
    const auto length = static_cast<float>(span.length);
    return (2.0F * t3 - 3.0F * t2 + 1.0F) * before +
           length * (t3 - 2.0F * t2 + t) * number(span.before, 2, component) +
           (3.0F * t2 - 2.0F * t3) * after + length * (t3 - t2) * number(span.after, 0, component);
}

glm::quat KeyTrack::rotation_at(double seconds) const {
    const Span span = span_at(seconds);
    if (span.before != span.after && interpolation == Interpolation::linear) {
        return glm::normalize(glm::slerp(unit_quaternion(at(double{times[span.before]})),
                                         unit_quaternion(at(double{times[span.after]})),
                                         span.share));
    }
    return unit_quaternion(at(seconds));
}

}  // namespace raybundle
