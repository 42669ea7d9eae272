// SPDX-License-Identifier: Apache-2.0
#include "scene/default_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace raybundle {
namespace {

constexpr float outside_fov = 0.7F;  // 40 degrees
constexpr float inside_fov = 1.05F;  // 60 degrees
constexpr float roomy_share = 0.25F;
constexpr float snap_cosine = 0.95F;
// Some hundred rays at all triangles: beyond this it would take seconds.
constexpr std::size_t max_traced_triangles = 500'000;
constexpr int directions = 64;
constexpr int interior_hits = 58;  // of all directions
constexpr int stage_hits = 35;
constexpr int horizontal_directions = 16;

struct WorldTriangle {
    glm::vec3 a, ab, ac;
};

struct Hit {
    float distance = std::numeric_limits<float>::infinity();
    bool front = false;
};

std::vector<WorldTriangle> world_triangles(const Scene& scene) {
    std::vector<glm::mat4> world;
    for (const Object& object : scene.objects) {
        world.push_back(object.world_from_object());
    }
    std::vector<WorldTriangle> triangles;
    triangles.reserve(scene.triangles.size());
    for (const Triangle& triangle : scene.triangles) {
        glm::vec3 p[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = glm::vec3(world[triangle.object] *
                             glm::vec4(scene.vertices[triangle.vertex[k]].position, 1.0F));
        }
        triangles.push_back({p[0], p[1] - p[0], p[2] - p[0]});
    }
    return triangles;
}

/// Nearest hit of a ray, by Möller and Trumbore 1997. A few dozen rays do not want a tree.
Hit trace(const std::vector<WorldTriangle>& triangles, const glm::vec3& origin,
          const glm::vec3& direction) {
    Hit nearest;
    for (const WorldTriangle& triangle : triangles) {
        const glm::vec3 p = glm::cross(direction, triangle.ac);
        const float determinant = glm::dot(triangle.ab, p);
        if (determinant == 0.0F) {
            continue;
        }
        const glm::vec3 t = origin - triangle.a;
        const float u = glm::dot(t, p) / determinant;
        const glm::vec3 q = glm::cross(t, triangle.ab);
        const float v = glm::dot(direction, q) / determinant;
        const float distance = glm::dot(triangle.ac, q) / determinant;
        if (u >= 0.0F && v >= 0.0F && u + v <= 1.0F && distance > 0.0F &&
            distance < nearest.distance) {
            nearest = {distance, determinant > 0.0F};
        }
    }
    return nearest;
}

/// What rays in evenly spread directions meet.
struct Surroundings {
    int hits = 0;
    int front_hits = 0;
    glm::vec3 open{0.0F};  // mean direction of the rays that meet nothing
};

/// Directions of a Fibonacci lattice on the sphere.
glm::vec3 spread_direction(int i) {
    const float golden_angle = std::numbers::pi_v<float> * (3.0F - std::sqrt(5.0F));
    const float y = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(directions);
    const float radius = std::sqrt(1.0F - y * y);
    const float angle = golden_angle * static_cast<float>(i);
    return {radius * std::cos(angle), y, radius * std::sin(angle)};
}

Surroundings look_around(const std::vector<WorldTriangle>& triangles, const glm::vec3& origin) {
    Surroundings result;
    for (int i = 0; i < directions; ++i) {
        const Hit hit = trace(triangles, origin, spread_direction(i));
        if (std::isfinite(hit.distance)) {
            ++result.hits;
            result.front_hits += hit.front ? 1 : 0;
        } else {
            result.open += spread_direction(i);
        }
    }
    result.open /= static_cast<float>(std::max(directions - result.hits, 1));
    return result;
}

/// A stage is looked into at right angles where its opening nearly faces along an axis.
glm::vec3 snapped_horizontal(const glm::vec3& direction) {
    const glm::vec3 horizontal = glm::normalize(glm::vec3(direction.x, 0.0F, direction.z));
    for (const glm::vec3& axis : {glm::vec3(1, 0, 0), glm::vec3(0, 0, 1)}) {
        const float cosine = glm::dot(horizontal, axis);
        if (std::abs(cosine) > snap_cosine) {
            return std::copysign(1.0F, cosine) * axis;
        }
    }
    return horizontal;
}

/// Nothing where there is too little room to look around: inside of a solid, say.
std::optional<Camera> inside(const std::vector<WorldTriangle>& triangles, const Bounds& bounds,
                             const glm::vec3& middle) {
    Camera camera;
    float longest = 0.0F;
    glm::vec3 direction(0.0F, 0.0F, 1.0F);
    for (int i = 0; i < horizontal_directions; ++i) {
        const float angle = (static_cast<float>(i) + 0.37F) * 2.0F * std::numbers::pi_v<float> /
                            horizontal_directions;
        const glm::vec3 candidate(std::cos(angle), 0.0F, std::sin(angle));
        const float distance = trace(triangles, middle, candidate).distance;
        if (std::isfinite(distance) && distance > longest) {
            longest = distance;
            direction = candidate;
        }
    }
    const glm::vec3 extent = bounds.extent();
    if (longest < roomy_share * std::max(extent.x, extent.z)) {
        return std::nullopt;
    }
    camera.eye = middle + 0.85F * longest * direction;
    camera.target = middle;
    camera.vertical_fov = inside_fov;
    return camera;
}

Camera outside(const Bounds& bounds, const glm::vec3& direction) {
    Camera camera;
    const float radius = 0.5F * glm::length(bounds.extent());
    camera.target = bounds.centre();
    camera.eye =
        camera.target + glm::normalize(direction) * (radius / std::sin(0.5F * outside_fov));
    camera.vertical_fov = outside_fov;
    return camera;
}

bool is_enclosed(const Surroundings& around) {
    return 2 * around.front_hits > around.hits;
}

/// Inside of the most enclosed of nine places at half height, the middle first among equals: a room
/// need not be in the middle of its building or site.
std::optional<Camera> find_interior(const std::vector<WorldTriangle>& triangles,
                                    const Bounds& bounds) {
    std::optional<Camera> best;
    int best_front_hits = 0;
    for (const int i : {4, 0, 1, 2, 3, 5, 6, 7, 8}) {
        const int column = i % 3;
        const int row = i / 3;
        const glm::vec3 offset(static_cast<float>(column - 1), 0.0F, static_cast<float>(row - 1));
        const glm::vec3 place = bounds.centre() + 0.3F * offset * bounds.extent();
        const Surroundings around = look_around(triangles, place);
        if (!is_enclosed(around) || around.hits < interior_hits ||
            around.front_hits <= best_front_hits) {
            continue;
        }
        if (auto camera = inside(triangles, bounds, place)) {
            best_front_hits = around.front_hits;
            best = std::move(camera);
        }
    }
    return best;
}

/// From the open side of a stage, or from inside of an interior; nothing for other scenes.
std::optional<Camera> find_view(const Scene& scene) {
    const std::vector<WorldTriangle> triangles = world_triangles(scene);
    const Surroundings around = look_around(triangles, scene.bounds.centre());
    const bool stage = is_enclosed(around) && around.hits >= stage_hits &&
                       around.hits < interior_hits && glm::length(around.open) > 0.5F &&
                       std::abs(around.open.y) < 0.5F;
    if (stage) {
        return outside(scene.bounds, snapped_horizontal(around.open));
    }
    return find_interior(triangles, scene.bounds);
}

}  // namespace

Camera default_camera(const Scene& scene) {
    Camera camera = outside(scene.bounds, {0.45F, 0.35F, 1.0F});
    if (scene.triangles.size() <= max_traced_triangles) {
        camera = find_view(scene).value_or(camera);
    }
    camera.name = "default";
    return camera;
}

}  // namespace raybundle
