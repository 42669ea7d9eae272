// SPDX-License-Identifier: Apache-2.0
// A luminaire with an opening, and what it brings by sums in double that share nothing with the
// server but its place.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <string>

#include "scene/light/light_place.h"
#include "scene/light/punctual_light.h"

namespace raybundle {

/// cd, towards a direction away from the light, in its axes: more in the plane C0 than in C90.
inline double panel_candela(const glm::dvec3& d) {
    return d.z < 0.0 ? 300.0 * -d.z * (1.0 + 0.3 * (d.x * d.x - d.y * d.y)) : 0.0;
}

/// The same as a EULUMDAT file; straight lines over its steps are 0.1 % below it at most. along_x,
/// along_y: of the opening, m; along_y 0: round.
inline std::shared_ptr<const IesProfile> panel_profile(double along_x, double along_y) {
    constexpr int planes = 72;  // 5° apart, of which a quarter is in the file
    constexpr int angles = 37;  // 2.5° apart
    const double length = along_y > 0.0 ? along_y : along_x;  // lies across C0
    const double width = along_y > 0.0 ? along_x : 0.0;
    std::string text = fmt::format(
        "Maker\n1\n4\n{}\n5\n{}\n2.5\nreport\npanel\n1\npanel.ldt\ntoday\n620\n620\n50\n"
        "{}\n{}\n0\n0\n0\n0\n100\n94\n1\n0\n1\n1\nLED\n1000\n4000\n80\n30\n"
        "0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n",
        planes, angles, 1000.0 * length, 1000.0 * width);
    for (int plane = 0; plane < planes; ++plane) {
        text += fmt::format("{}\n", 5 * plane);
    }
    for (int angle = 0; angle < angles; ++angle) {
        text += fmt::format("{}\n", 2.5 * angle);
    }
    for (int plane = 0; plane <= planes / 4; ++plane) {
        const double c = glm::radians(5.0 * plane);
        for (int angle = 0; angle < angles; ++angle) {
            const double gamma = glm::radians(2.5 * angle);
            text += fmt::format("{:.6f}\n",
                                panel_candela({std::sin(gamma) * std::cos(c),
                                               std::sin(gamma) * std::sin(c), -std::cos(gamma)}));
        }
    }
    return std::make_shared<const IesProfile>(parse_eulumdat("panel.ldt", text));
}

inline PunctualLight panel_light(const LightPlace& place, double along_x, double along_y) {
    PunctualLight light;
    light.name = "panel";
    light.intensity = glm::vec3(1.0F);
    light.profile = panel_profile(along_x, along_y);
    set_place(place, light);
    return light;
}

/// Illuminance of a surface of this normal at a point by n x n points of a panel, lx. sees: whether
/// a place of the panel sees the point.
inline double panel_illuminance(
    const PunctualLight& light, double along_x, double along_y, const glm::dvec3& point,
    const glm::dvec3& normal, int n = 120,
    const std::function<bool(const glm::dvec3&)>& sees = [](const auto&) { return true; }) {
    const glm::dmat3 axes(light.axes);
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < n * n; ++i) {
        glm::dvec2 at = 2.0 * (glm::dvec2(i % n, i / n) + 0.5) / static_cast<double>(n) - 1.0;
        if (along_y == 0.0 && glm::length(at) > 1.0) {
            continue;  // round
        }
        ++count;
        at *= 0.5 * glm::dvec2(along_x, along_y > 0.0 ? along_y : along_x);
        const glm::dvec3 place = glm::dvec3(light.position) + at.x * axes[0] + at.y * axes[1];
        const glm::dvec3 to = place - point;
        const double distance = glm::length(to);
        if (sees(place)) {
            sum += panel_candela(-to / distance * axes) *
                   std::max(glm::dot(normal, to) / distance, 0.0) / (distance * distance);
        }
    }
    return sum / count;
}

}  // namespace raybundle
