// SPDX-License-Identifier: Apache-2.0
#include "scene/walk/walk_map.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace raybundle {
namespace {

/// A convex polygon: a triangle that has been cut a few times.
struct Polygon {
    std::array<glm::vec3, 8> corners;
    int count = 0;

    void add(const glm::vec3& corner) { corners[static_cast<std::size_t>(count++)] = corner; }
};

/// The part of a polygon on one side: sign * (corner[axis] - at) >= 0.
Polygon part_beyond(const Polygon& polygon, int axis, float at, float sign) {
    Polygon part;
    for (int i = 0; i < polygon.count; ++i) {
        const glm::vec3& a = polygon.corners[static_cast<std::size_t>(i)];
        const glm::vec3& b = polygon.corners[static_cast<std::size_t>((i + 1) % polygon.count)];
        const float da = sign * (a[axis] - at);
        const float db = sign * (b[axis] - at);
        if (da >= 0.0F) {
            part.add(a);
        }
        if ((da < 0.0F) != (db < 0.0F)) {
            part.add(a + da / (da - db) * (b - a));
        }
    }
    return part;
}

/// Half-open range of the cells that a polygon reaches along an axis.
std::pair<int, int> cells_of(const Polygon& polygon, int axis, float cell, int cells) {
    float low = polygon.corners[0][axis];
    float high = low;
    for (int i = 1; i < polygon.count; ++i) {
        low = std::min(low, polygon.corners[static_cast<std::size_t>(i)][axis]);
        high = std::max(high, polygon.corners[static_cast<std::size_t>(i)][axis]);
    }
    const auto most = static_cast<float>(cells);
    const float first = std::floor(low / cell);
    const float last = std::floor(high / cell) + 1.0F;
    return {static_cast<int>(std::clamp(first, 0.0F, most)),
            static_cast<int>(std::clamp(last, 0.0F, most))};
}

class Filler {
  public:
    explicit Filler(WalkMap& map) : map_(map) {}

    /// corners: in the map's space.
    void fill(const std::array<glm::vec3, 3>& corners) {
        Polygon triangle;
        for (const glm::vec3& corner : corners) {
            triangle.add(corner);
        }
        const auto [first, last] = cells_of(triangle, 0, WalkMap::cell, WalkMap::columns);
        for (int x = first; x < last; ++x) {
            const Polygon strip = slab(triangle, 0, x);
            if (strip.count == 0) {
                continue;
            }
            const auto [near, far] = cells_of(strip, 2, WalkMap::cell, WalkMap::columns);
            for (int z = near; z < far; ++z) {
                fill_column(slab(strip, 2, z), z * WalkMap::columns + x);
            }
        }
    }

  private:
    static Polygon slab(const Polygon& polygon, int axis, int cell) {
        const float at = static_cast<float>(cell) * WalkMap::cell;
        const Polygon above = part_beyond(polygon, axis, at, 1.0F);
        return above.count == 0 ? above : part_beyond(above, axis, at + WalkMap::cell, -1.0F);
    }

    void fill_column(const Polygon& part, int column) {
        if (part.count == 0) {
            return;
        }
        const auto [low, high] = cells_of(part, 1, WalkMap::layer, WalkMap::layers);
        for (int y = low; y < high; ++y) {
            map_.occupied[static_cast<std::size_t>(column)] |= std::uint64_t{1} << y;
        }
    }

    WalkMap& map_;
};

bool overlap(const Bounds& a, const Bounds& b) {
    return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
}

/// Whether something in the box may lie straight below a point.
bool below(const Bounds& box, const glm::vec3& point) {
    return box.min.x <= point.x && point.x <= box.max.x && box.min.z <= point.z &&
           point.z <= box.max.z && box.min.y <= point.y;
}

/// Height at which the vertical line through a point meets a triangle below it.
std::optional<float> height_below(const std::array<glm::vec3, 3>& corners, const glm::vec3& point) {
    const auto area = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
        return (b.x - a.x) * (c.z - a.z) - (b.z - a.z) * (c.x - a.x);
    };
    const double all = area(corners[0], corners[1], corners[2]);
    if (all == 0.0) {
        return std::nullopt;  // upright
    }
    double height = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double share = area(point, corners[(k + 1) % 3], corners[(k + 2) % 3]) / all;
        if (share < 0.0) {
            return std::nullopt;
        }
        height += share * static_cast<double>(corners[k].y);
    }
    return height <= static_cast<double>(point.y) ? std::optional(static_cast<float>(height))
                                                  : std::nullopt;
}

Bounds placed_bounds(const Object& object, const glm::mat4& world) {
    Bounds result;
    for (unsigned corner = 0; corner < 8 && !object.bounds.empty(); ++corner) {
        const glm::vec3 p((corner & 1U) != 0 ? object.bounds.max.x : object.bounds.min.x,
                          (corner & 2U) != 0 ? object.bounds.max.y : object.bounds.min.y,
                          (corner & 4U) != 0 ? object.bounds.max.z : object.bounds.min.z);
        result.add(glm::vec3(world * glm::vec4(p, 1.0F)));
    }
    return result;
}

}  // namespace

std::vector<glm::mat4> object_places(const Scene& scene) {
    std::vector<glm::mat4> worlds;
    worlds.reserve(scene.objects.size());
    for (const Object& object : scene.objects) {
        worlds.push_back(object.world_from_object());
    }
    return worlds;
}

WalkMap make_walk_map(const Scene& scene, const glm::vec3& eye) {
    return make_walk_map(scene, object_places(scene), eye);
}

WalkMap make_walk_map(const Scene& scene, std::span<const glm::mat4> worlds, const glm::vec3& eye) {
    WalkMap map;
    map.occupied.assign(std::size_t{WalkMap::columns} * WalkMap::columns, 0);
    const float half = 0.5F * WalkMap::columns * WalkMap::cell;
    // On one grid for all, so that what one map says of a place others say too.
    const glm::vec3 grid(WalkMap::cell, WalkMap::layer, WalkMap::cell);
    map.origin = glm::floor((eye - glm::vec3(half, WalkMap::below, half)) / grid) * grid;
    const glm::vec3 size(2.0F * half, WalkMap::layers * WalkMap::layer, 2.0F * half);
    const Bounds box{map.origin, map.origin + size};
    std::vector<bool> near;
    for (const Object& object : scene.objects) {
        if (near.size() >= worlds.size()) {  // it has been added since
            near.push_back(false);
            continue;
        }
        const glm::mat4& world = worlds[near.size()];
        const Bounds bounds = placed_bounds(object, world);
        const bool removed = glm::mat3(world) == glm::mat3(0.0F);
        near.push_back(!removed && object.kind != ObjectKind::door &&
                       (overlap(bounds, box) || below(bounds, eye)));
    }
    Filler filler(map);
    for (const Triangle& triangle : scene.triangles) {
        if (!near[triangle.object]) {
            continue;
        }
        Bounds bounds;
        std::array<glm::vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = glm::vec3(worlds[triangle.object] *
                                   glm::vec4(scene.vertices[triangle.vertex[k]].position, 1.0F));
            bounds.add(corners[k]);
        }
        if (below(bounds, eye)) {
            const auto height = height_below(corners, eye);
            map.floor = height && (!map.floor || *height > *map.floor) ? height : map.floor;
        }
        if (overlap(bounds, box)) {
            for (glm::vec3& corner : corners) {
                corner -= map.origin;
            }
            filler.fill(corners);
        }
    }
    return map;
}

}  // namespace raybundle
