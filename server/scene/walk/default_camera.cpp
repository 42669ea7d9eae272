// SPDX-License-Identifier: Apache-2.0
#include "scene/walk/default_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "scene/contact/spread_direction.h"
#include "scene/walk/standing_views.h"
#include "scene/walk/world_rays.h"

namespace raybundle {
namespace {

constexpr float outside_fov = 0.7F;  // 40 degrees
constexpr float inside_fov = 1.05F;  // 60 degrees
constexpr float roomy_share = 0.25F;
constexpr float snap_cosine = 0.95F;
constexpr std::size_t most_standing = 6;
constexpr int directions = 64;
constexpr int interior_hits = 58;  // of all directions
constexpr int stage_hits = 35;
constexpr int horizontal_directions = 16;

/// What rays in evenly spread directions meet.
struct Surroundings {
    int hits = 0;
    int front_hits = 0;
    glm::vec3 open{0.0F};  // mean direction of the rays that meet nothing
};

Surroundings look_around(const WorldRays& rays, const glm::vec3& origin) {
    Surroundings result;
    for (int i = 0; i < directions; ++i) {
        const WorldRays::Hit hit = rays.trace(origin, spread_direction(i, directions));
        if (hit.met()) {
            ++result.hits;
            result.front_hits += hit.front ? 1 : 0;
        } else {
            result.open += spread_direction(i, directions);
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
std::optional<Camera> inside(const WorldRays& rays, const Bounds& bounds, const glm::vec3& middle) {
    Camera camera;
    float longest = 0.0F;
    glm::vec3 direction(0.0F, 0.0F, 1.0F);
    for (int i = 0; i < horizontal_directions; ++i) {
        const float angle = (static_cast<float>(i) + 0.37F) * 2.0F * std::numbers::pi_v<float> /
                            horizontal_directions;
        const glm::vec3 candidate(std::cos(angle), 0.0F, std::sin(angle));
        const float distance = rays.trace(middle, candidate).distance;
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
std::optional<Camera> find_interior(const WorldRays& rays, const Bounds& bounds) {
    std::optional<Camera> best;
    int best_front_hits = 0;
    for (const int i : {4, 0, 1, 2, 3, 5, 6, 7, 8}) {
        const int column = i % 3;
        const int row = i / 3;
        const glm::vec3 offset(static_cast<float>(column - 1), 0.0F, static_cast<float>(row - 1));
        const glm::vec3 place = bounds.centre() + 0.3F * offset * bounds.extent();
        const Surroundings around = look_around(rays, place);
        if (!is_enclosed(around) || around.hits < interior_hits ||
            around.front_hits <= best_front_hits) {
            continue;
        }
        if (auto camera = inside(rays, bounds, place)) {
            best_front_hits = around.front_hits;
            best = std::move(camera);
        }
    }
    return best;
}

/// From the open side of a stage; nothing for other scenes.
std::optional<Camera> find_stage(const Scene& scene, const WorldRays& rays) {
    const Surroundings around = look_around(rays, scene.bounds.centre());
    const bool stage = is_enclosed(around) && around.hits >= stage_hits &&
                       around.hits < interior_hits && glm::length(around.open) > 0.5F &&
                       std::abs(around.open.y) < 0.5F;
    return stage ? std::optional(outside(scene.bounds, snapped_horizontal(around.open)))
                 : std::nullopt;
}

}  // namespace

std::vector<Camera> default_cameras(const Scene& scene) {
    const WorldRays rays(scene);
    std::vector<Camera> cameras;
    if (const auto stage = find_stage(scene, rays)) {
        cameras.push_back(*stage);
        cameras.back().name = "from the open side";
    }
    const std::vector<Camera> standing = standing_views(scene, rays, most_standing);
    cameras.insert(cameras.end(), standing.begin(), standing.end());
    if (cameras.empty()) {
        if (const auto interior = find_interior(rays, scene.bounds)) {
            cameras.push_back(*interior);
            cameras.back().name = "inside";
        }
    }
    cameras.push_back(outside(scene.bounds, {0.45F, 0.35F, 1.0F}));
    cameras.back().name = "from outside";
    return cameras;
}

}  // namespace raybundle
