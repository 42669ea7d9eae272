// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "gpu/layouts.h"

namespace raybundle {

/// Texels of a layer of the shadow maps, first and last; none where `last` is before `first`.
struct MapTexels {
    glm::ivec2 first{0};
    glm::ivec2 last{-1};

    [[nodiscard]] bool empty() const { return last.x < first.x || last.y < first.y; }
    [[nodiscard]] double count() const {
        return empty() ? 0.0
                       : static_cast<double>(last.x - first.x + 1) *
                             static_cast<double>(last.y - first.y + 1);
    }
    void add(const MapTexels& other);
    /// All of a map of this size.
    static MapTexels whole(int size) { return {glm::ivec2(0), glm::ivec2(size - 1)}; }
};

// What a change reaches of the maps of a light: PunctualData::touched.

void set_touched(layout::PunctualData& light, unsigned face, const MapTexels& texels);
[[nodiscard]] MapTexels touched(const layout::PunctualData& light, unsigned face);
/// Round what is touched, from what is.
void enclose_touched(layout::PunctualData& light);
void touch_nothing(layout::PunctualData& light);
void touch_all(layout::PunctualData& light);
[[nodiscard]] bool is_touched(const layout::PunctualData& light);
/// Direction of a place on a face of a light's map, [-1, 1], away from a light that is somewhere.
[[nodiscard]] glm::vec3 map_direction(const layout::PunctualData& light, unsigned face,
                                      const glm::vec2& at);
/// Axes of a face of a cube map; the same table as cube_face() in shaders/solution/first_shot.glsl.
struct FaceAxes {
    glm::vec3 right{0.0F}, up{0.0F}, forward{0.0F};
};
[[nodiscard]] FaceAxes face_axes(unsigned face);
/// Share of all texels.
[[nodiscard]] double touched_share(std::span<const layout::PunctualData> lights);

}  // namespace raybundle
