// SPDX-License-Identifier: Apache-2.0
#include "solution/direct/map_touch.h"

#include <algorithm>
#include <vector>

namespace raybundle {

namespace {

constexpr unsigned faces_a_row = 2;  // of PunctualData::touched

unsigned packed(const glm::ivec2& texel) {
    return static_cast<unsigned>(texel.x) | static_cast<unsigned>(texel.y) << 16U;
}

glm::ivec2 unpacked(unsigned texel) {
    return {static_cast<int>(texel & 0xffffU), static_cast<int>(texel >> 16U)};
}

}  // namespace

void MapTexels::add(const MapTexels& other) {
    if (other.empty()) {
        return;
    }
    first = empty() ? other.first : glm::min(first, other.first);
    last = glm::max(last, other.last);
}

void set_touched(layout::PunctualData& light, unsigned face, const MapTexels& texels) {
    constexpr unsigned none[2] = {0xffffffffU, 0U};
    glm::uvec4& row = light.touched[face / faces_a_row];
    const int at = static_cast<int>(2 * (face % faces_a_row));
    row[at] = texels.empty() ? none[0] : packed(texels.first);
    row[at + 1] = texels.empty() ? none[1] : packed(texels.last);
}

MapTexels touched(const layout::PunctualData& light, unsigned face) {
    const glm::uvec4& row = light.touched[face / faces_a_row];
    const int at = static_cast<int>(2 * (face % faces_a_row));
    return {unpacked(row[at]), unpacked(row[at + 1])};
}

FaceAxes face_axes(unsigned face) {
    const int axis = static_cast<int>(face / 2);
    const float sign = (face & 1U) != 0 ? -1.0F : 1.0F;
    FaceAxes axes;
    axes.forward[axis] = sign;
    axes.right[(axis + 1) % 3] = -sign;
    axes.up[(axis + 2) % 3] = 1.0F;
    return axes;
}

glm::vec3 map_direction(const layout::PunctualData& light, unsigned face, const glm::vec2& at) {
    if (light.map.y == 6) {
        const FaceAxes axes = face_axes(face);
        return axes.forward + at.x * axes.right + at.y * axes.up;
    }
    return light.position.w * (at.x * glm::vec3(light.axis_x) + at.y * glm::vec3(light.axis_y)) -
           glm::vec3(light.axis_z);
}

void enclose_touched(layout::PunctualData& light) {
    constexpr glm::vec4 everything(0.0F, 0.0F, 0.0F, -2.0F);
    constexpr glm::vec4 nothing(0.0F, 0.0F, 0.0F, 2.0F);
    const auto size = static_cast<float>(light.map.w);
    std::vector<glm::vec3> directions;
    for (unsigned face = 0; face < light.map.y; ++face) {
        const MapTexels texels = touched(light, face);
        if (texels.empty()) {
            continue;
        }
        // A point looks up the texels round it; those at the map's rim stand for all beyond.
        const glm::vec2 low = glm::vec2(texels.first - 1) / size * 2.0F - 1.0F;
        const glm::vec2 high = glm::vec2(texels.last + 2) / size * 2.0F - 1.0F;
        const bool at_rim =
            light.map.y == 1 && (glm::any(glm::lessThanEqual(low, glm::vec2(-1.0F))) ||
                                 glm::any(glm::greaterThanEqual(high, glm::vec2(1.0F))));
        if (at_rim || light.map.z == PUNCTUAL_DIRECTIONAL) {
            light.touched_cone = everything;
            return;
        }
        for (const glm::vec2& at :
             {low, high, glm::vec2(low.x, high.y), glm::vec2(high.x, low.y)}) {
            directions.push_back(glm::normalize(map_direction(light, face, at)));
        }
    }
    glm::vec3 axis(0.0F);
    for (const glm::vec3& direction : directions) {
        axis += direction;
    }
    if (directions.empty()) {
        light.touched_cone = nothing;
        return;
    }
    axis = glm::length(axis) > 0.0F ? glm::normalize(axis) : glm::vec3(0.0F);
    float cosine = 1.0F;
    for (const glm::vec3& direction : directions) {
        cosine = std::min(cosine, glm::dot(axis, direction));
    }
    constexpr float rounding = 1e-5F;
    // Beyond half of all directions a cone round the corners need not hold what is between them.
    light.touched_cone = cosine > 0.0F ? glm::vec4(axis, cosine - rounding) : everything;
}

void touch_nothing(layout::PunctualData& light) {
    for (unsigned face = 0; face < light.map.y; ++face) {
        set_touched(light, face, {});
    }
    enclose_touched(light);
}

void touch_all(layout::PunctualData& light) {
    for (unsigned face = 0; face < light.map.y; ++face) {
        set_touched(light, face, MapTexels::whole(static_cast<int>(light.map.w)));
    }
    enclose_touched(light);
}

bool is_touched(const layout::PunctualData& light) {
    for (unsigned face = 0; face < light.map.y; ++face) {
        if (!touched(light, face).empty()) {
            return true;
        }
    }
    return false;
}

double touched_share(std::span<const layout::PunctualData> lights) {
    double sum = 0.0;
    double all = 0.0;
    for (const layout::PunctualData& light : lights) {
        for (unsigned face = 0; face < light.map.y; ++face) {
            sum += touched(light, face).count();
            all += MapTexels::whole(static_cast<int>(light.map.w)).count();
        }
    }
    return all > 0.0 ? sum / all : 1.0;
}

}  // namespace raybundle
