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

glm::vec4 KeyTrack::key(std::size_t index, std::size_t part) const {
    const std::size_t parts = interpolation == Interpolation::cubic_spline ? 3 : 1;
    glm::vec4 result(0.0F);
    for (std::size_t c = 0; c < components; ++c) {
        result[static_cast<int>(c)] = values[(index * parts + part) * components + c];
    }
    return result;
}

float KeyTrack::number(std::size_t index, std::size_t part, std::size_t component) const {
    const std::size_t parts = interpolation == Interpolation::cubic_spline ? 3 : 1;
    return values[(index * parts + part) * components + component];
}

glm::vec4 KeyTrack::value(std::size_t index) const {
    return key(index, interpolation == Interpolation::cubic_spline ? 1 : 0);
}

/// glTF 2.0, appendix C.5: a Hermite spline whose tangents are per second.
glm::vec4 KeyTrack::spline(const Span& span) const {
    const float t = span.share;
    const float t2 = t * t;
    const float t3 = t2 * t;
    const auto length = static_cast<float>(span.length);
    return (2.0F * t3 - 3.0F * t2 + 1.0F) * key(span.before, 1) +
           length * (t3 - 2.0F * t2 + t) * key(span.before, 2) +
           (3.0F * t2 - 2.0F * t3) * key(span.after, 1) + length * (t3 - t2) * key(span.after, 0);
}

glm::vec4 KeyTrack::at(double seconds) const {
    const Span span = span_at(seconds);
    if (span.before == span.after || interpolation == Interpolation::step) {
        return value(span.before);
    }
    return interpolation == Interpolation::linear
               ? glm::mix(value(span.before), value(span.after), span.share)
               : spline(span);
}

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
        return glm::normalize(glm::slerp(unit_quaternion(value(span.before)),
                                         unit_quaternion(value(span.after)), span.share));
    }
    return unit_quaternion(at(seconds));
}

}  // namespace raybundle
