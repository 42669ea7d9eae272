// SPDX-License-Identifier: Apache-2.0
#include "scene/light/punctual_light.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scene/scene.h"

namespace raybundle {
namespace {

/// The nearest axes whose z is exact: objects may be scaled, sheared or mirrored. Right-handed, or
/// of the same hand as those that are given.
glm::dmat3 orthonormal(const glm::dmat3& axes, bool keep_hand = false) {
    const double length = glm::length(axes[2]);
    const glm::dvec3 z = length > 0.0 ? axes[2] / length : glm::dvec3(0.0, 0.0, 1.0);
    glm::dvec3 x = axes[0] - glm::dot(axes[0], z) * z;
    if (!(glm::length(x) > 1e-9 * glm::length(axes[0]))) {
        const glm::dvec3 other = std::abs(z.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
        x = other - glm::dot(other, z) * z;
    }
    x = glm::normalize(x);
    const glm::dvec3 y = glm::cross(z, x);
    return {x, keep_hand && glm::determinant(axes) < 0.0 ? -y : y, z};
}

}  // namespace

glm::vec3 colour_of(const PunctualLight& light) {
    const float intensity = luminance(light.intensity);
    return intensity > 0.0F ? light.intensity / intensity : light.dark_colour;
}

std::optional<ColourRendering> colour_rendering_of(const LightControl& control) {
    return control.colour_rendering ? std::optional(ColourRendering{*control.colour_rendering,
                                                                    *control.colour_rendering})
                                    : std::nullopt;
}

std::optional<ColourRendering> colour_rendering_of(const PunctualLight& light) {
    const std::optional<ColourRendering> set = colour_rendering_of(light.control);
    return set || !light.profile ? set : light.profile->data().colour_rendering;
}

PunctualSetting setting_of(const PunctualLight& light) {
    return light.setting.value_or(
        PunctualSetting{light.intensity, colour_of(light), true, light.intensity});
}

float intensity_unit(const PunctualLight& light) {
    const double flux = light.profile ? light.profile->flux() : 0.0;
    return flux > 0.0 ? static_cast<float>(flux) : 1.0F;
}

PlacedLight place_light(const PunctualLight& light, const glm::mat4& world_from_object) {
    const glm::dmat4 world(world_from_object);
    PlacedLight placed;
    placed.kind = light.kind;
    placed.position = glm::dvec3(world * glm::dvec4(glm::dvec3(light.position), 1.0));
    // A mirrored luminaire throws to the mirrored side.
    placed.axes = orthonormal(glm::dmat3(world) * glm::dmat3(light.axes), light.profile != nullptr);
    placed.intensity = glm::dvec3(light.intensity);
    placed.angular_radius = static_cast<double>(light.angular_radius);
    placed.inner_cosine = light.inner_cosine;
    placed.outer_cosine = light.outer_cosine;
    placed.profile = light.profile;
    placed.opening = opening_of(light.profile.get());
    if (light.part != PunctualLight::whole) {
        const OpeningPart part = part_of(placed.opening, static_cast<unsigned>(light.part));
        placed.position += placed.axes[0] * part.seen_from.x + placed.axes[1] * part.seen_from.y;
        placed.opening = part.opening;
    }
    return placed;
}

std::vector<PunctualLight> without_discs(std::span<const PunctualLight> lights) {
    constexpr int parts = 8;
    std::vector<PunctualLight> result;
    for (const PunctualLight& light : lights) {
        if (light.kind != PunctualKind::directional || !(light.angular_radius > 0.0F)) {
            result.push_back(light);
            continue;
        }
        for (int i = 0; i < parts; ++i) {  // Vogel's spiral: equal areas
            constexpr float golden_angle = 2.39996323F;
            const float from_axis =
                std::sin(light.angular_radius) * std::sqrt((static_cast<float>(i) + 0.5F) / parts);
            const float angle = golden_angle * static_cast<float>(i);
            PunctualLight part = light;
            part.angular_radius = 0.0F;
            part.intensity /= static_cast<float>(parts);
            part.axes = glm::mat3(orthonormal(glm::dmat3(light.axes)));
            part.axes[2] =
                part.axes * glm::vec3(from_axis * std::cos(angle), from_axis * std::sin(angle),
                                      std::sqrt(1.0F - from_axis * from_axis));
            result.push_back(part);
        }
    }
    return result;
}

std::vector<PunctualLight> in_parts(const PunctualLight& light) {
    std::vector<PunctualLight> parts(LuminousOpening::parts, light);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        parts[i].part = static_cast<int>(i);
        parts[i].intensity /= static_cast<float>(parts.size());
    }
    return parts;
}

glm::dvec3 PlacedLight::point(const glm::dvec2& u) const {
    const glm::dvec2 aside = opening.at(u);
    return position + axes[0] * aside.x + axes[1] * aside.y;
}

/// KHR_lights_punctual, "Inner and Outer Cone Angles".
double PlacedLight::attenuation(const glm::dvec3& direction) const {
    if (profile) {
        return profile->candela(direction * axes);  // in its own axes
    }
    if (kind != PunctualKind::spot) {
        return 1.0;
    }
    const double cosine = -glm::dot(axes[2], direction);
    const double share = (cosine - outer_cosine) / (inner_cosine - outer_cosine);
    const double clamped = glm::clamp(share, 0.0, 1.0);
    return clamped * clamped;
}

glm::dvec3 PlacedLight::towards(const glm::dvec3& direction) const {
    return intensity * attenuation(direction);
}

glm::dvec3 PlacedLight::flux() const {
    constexpr double pi = glm::pi<double>();
    if (profile) {
        return intensity * profile->flux();
    }
    if (kind != PunctualKind::spot) {
        return 4.0 * pi * intensity;
    }
    // Between the cones the attenuation is the square of a share linear in the cosine.
    return 2.0 * pi * (1.0 - inner_cosine + (inner_cosine - outer_cosine) / 3.0) * intensity;
}

}  // namespace raybundle
