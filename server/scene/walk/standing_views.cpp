// SPDX-License-Identifier: Apache-2.0
#include "scene/walk/standing_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "scene/contact/spread_direction.h"
#include "scene/light/environment.h"

namespace raybundle {
namespace {

constexpr float half_turn = std::numbers::pi_v<float>;
constexpr float standing_fov = 1.05F;   // 60 degrees
constexpr int places_a_side = 24;       // over the bounds
constexpr float nearest_places = 0.4F;  // m
constexpr float headroom = 1.9F;        // m: DIN 18202 doors are 1.985 m high at least
constexpr float elbow_room = 0.35F;     // m, around a person
constexpr float evenness = 0.02F;       // m: what a floor may rise within elbow_room
constexpr float level_cosine = 0.95F;   // of a floor's slope
constexpr int most_floors = 64;         // surfaces below one another
constexpr int looks_a_side = 8;
constexpr int looks = looks_a_side * looks_a_side;
constexpr int enclosing_hits = 52;  // of them: a wall of glass is no wall
constexpr int turnings = 32;
constexpr float step_back = 0.8F;      // share of the way to the wall behind
constexpr float longest_view = 15.0F;  // m: longer lines do not make a view better
constexpr float in_the_dark = 0.2F;    // worth of a place that no light reaches
constexpr float least_apart = 2.0F;    // m

struct Standing {
    glm::vec3 place{0.0F};  ///< before it goes back
    Camera camera;
    float worth = 0.0F;
};

class Finder {
  public:
    Finder(const Scene& scene, const WorldRays& rays, float metre)
        : scene_(scene), rays_(rays), metre_(metre) {
        const glm::vec3 mean(mean_sky(scene));
        sky_ = mean != glm::vec3(0.0F);
        any_light_ = sky_ || has_emitter(scene);
    }

    [[nodiscard]] std::vector<Standing> all() const {
        std::vector<Standing> found;
        const Bounds& bounds = scene_.bounds;
        const glm::vec3 extent = bounds.extent();
        const auto count = [this](float length) {
            return std::clamp(static_cast<int>(length / (nearest_places * metre_)), 1,
                              places_a_side);
        };
        const int columns = count(extent.x);
        const int rows = count(extent.z);
        for (int i = 0; i < columns * rows; ++i) {
            const int row = i / columns;
            const float u = (static_cast<float>(i % columns) + 0.5F) / static_cast<float>(columns);
            const float v = (static_cast<float>(row) + 0.5F) / static_cast<float>(rows);
            const glm::vec3 top(bounds.min.x + u * extent.x, bounds.max.y + metre_,
                                bounds.min.z + v * extent.z);
            for (const float floor : floors_below(top)) {
                if (auto standing = stand({top.x, floor + eye_height * metre_, top.z})) {
                    found.push_back(*standing);
                }
            }
        }
        return found;
    }

  private:
    /// Heights at which somebody could stand.
    [[nodiscard]] std::vector<float> floors_below(glm::vec3 from) const {
        std::vector<float> floors;
        float above = std::numeric_limits<float>::infinity();
        for (int k = 0; k < most_floors; ++k) {
            const WorldRays::Hit hit = rays_.trace(from, {0, -1, 0});
            if (!hit.met()) {
                break;
            }
            const float y = from.y - hit.distance;
            if (hit.normal.y > level_cosine && above - y >= headroom * metre_ && k > 0) {
                floors.push_back(y);
            }
            above = y;
            from.y = y - 1e-3F - 1e-5F * std::abs(y);
        }
        return floors;
    }

    [[nodiscard]] bool has_room(const glm::vec3& eye) const {
        for (int i = 0; i < 8; ++i) {
            const float angle = static_cast<float>(i) * half_turn / 4.0F;
            const glm::vec3 aside(std::cos(angle), 0.0F, std::sin(angle));
            if (rays_.trace(eye, aside).distance < elbow_room * metre_ ||
                rays_.trace(eye - glm::vec3(0, metre_, 0), aside).distance < elbow_room * metre_) {
                return false;
            }
            const float depth = rays_.trace(eye + elbow_room * metre_ * aside, {0, -1, 0}).distance;
            if (std::abs(depth - eye_height * metre_) > evenness * metre_) {
                return false;
            }
        }
        return true;
    }

    [[nodiscard]] bool lit(const glm::vec3& eye, int emitting) const {
        const auto reached = [&](const PunctualLight& light) {
            const PlacedLight placed = place_light(scene_, light);
            const glm::vec3 at = placed.kind == PunctualKind::directional
                                     ? eye - 1e4F * glm::vec3(placed.direction())
                                     : glm::vec3(placed.position);
            return !rays_.blocked(eye, eye + 0.999F * (at - eye));
        };
        return !any_light_ || emitting > 0 ||
               std::any_of(scene_.punctual_lights.begin(), scene_.punctual_lights.end(), reached);
    }

    [[nodiscard]] std::optional<Standing> stand(const glm::vec3& eye) const {
        if (!has_room(eye)) {
            return std::nullopt;
        }
        int hits = 0;
        int fronts = 0;
        int emitting = 0;
        for (int i = 0; i < looks; ++i) {
            const WorldRays::Hit hit = rays_.trace(eye, spread_direction(i, looks));
            hits += hit.met() ? 1 : 0;
            fronts += hit.met() && hit.front ? 1 : 0;
            emitting += hit.met() ? emits(hit) : sky_;
        }
        if (hits < enclosing_hits || 2 * fronts <= hits) {
            return std::nullopt;
        }
        Standing standing = look_along_longest(eye);
        const float shown = fronts_in_view(standing.camera);
        if (shown <= 0.5F) {
            return std::nullopt;
        }
        standing.worth *= shown;
        standing.worth *= lit(eye, emitting) ? 1.0F : in_the_dark;
        return standing;
    }

    /// Share of a picture that shows sides with light, or the sky: backs of walls are black.
    [[nodiscard]] float fronts_in_view(const Camera& camera) const {
        const glm::vec3 ahead = glm::normalize(camera.target - camera.eye);
        const glm::vec3 right = glm::normalize(glm::cross(ahead, glm::vec3(0, 1, 0)));
        const float half = std::tan(0.5F * camera.vertical_fov);
        int shown = 0;
        for (int i = 0; i < looks; ++i) {
            const int column = i % looks_a_side;
            const int row = i / looks_a_side;
            const float u = (static_cast<float>(column) + 0.5F) / looks_a_side;
            const float v = (static_cast<float>(row) + 0.5F) / looks_a_side;
            const glm::vec3 way = ahead + (2.0F * u - 1.0F) * half * right +
                                  (2.0F * v - 1.0F) * half * glm::vec3(0, 1, 0);
            const WorldRays::Hit hit = rays_.trace(camera.eye, glm::normalize(way));
            shown += (hit.met() ? hit.front : sky_) ? 1 : 0;
        }
        return static_cast<float>(shown) / looks;
    }

    [[nodiscard]] bool emits(const WorldRays::Hit& hit) const {
        return scene_.materials[scene_.triangles[hit.triangle].material].emission !=
               glm::vec3(0.0F);
    }

    /// Goes back from a place, and looks along the longest line through it that ends at a
    /// wall, at its lit side.
    [[nodiscard]] Standing look_along_longest(const glm::vec3& place) const {
        std::vector<float> length;
        for (int i = 0; i < turnings; ++i) {
            const WorldRays::Hit hit = rays_.trace(place, turn(i));
            length.push_back(hit.met() && hit.front ? std::min(hit.distance, longest_view * metre_)
                                                    : 0.0F);
        }
        int best = 0;
        for (int i = 1; i < turnings; ++i) {
            if (length[static_cast<std::size_t>(i)] > length[static_cast<std::size_t>(best)]) {
                best = i;
            }
        }
        const float behind = length[static_cast<std::size_t>((best + turnings / 2) % turnings)];
        Standing result;
        Camera& camera = result.camera;
        result.place = place;
        camera.eye = place;
        float back = step_back * behind;
        while (back > elbow_room * metre_ && !has_room(place - back * turn(best))) {
            back *= 0.5F;
        }
        if (back > elbow_room * metre_) {
            camera.eye = place - back * turn(best);
        }
        camera.target = camera.eye + metre_ * turn(best);
        camera.vertical_fov = standing_fov;
        const float ahead = length[static_cast<std::size_t>(best)];
        result.worth = std::min(ahead + glm::distance(camera.eye, place), longest_view * metre_);
        return result;
    }

    static glm::vec3 turn(int i) {
        const float angle = (static_cast<float>(i) + 0.37F) * 2.0F * half_turn / turnings;
        return {std::cos(angle), 0.0F, std::sin(angle)};
    }

    const Scene& scene_;
    const WorldRays& rays_;
    float metre_;
    bool sky_ = false;
    bool any_light_ = false;
};

/// What a metre is likely to be: 1, unless most places (some may be below a table) have a ceiling
/// so high above that the file is in another unit, as rooms drawn in millimetres are without
/// --unit.
float likely_metre(const WorldRays& rays, const std::vector<Standing>& found) {
    constexpr float highest_hall = 50.0F;
    constexpr float usual_room = 2.5F;
    std::vector<float> heights;
    for (const Standing& standing : found) {
        const WorldRays::Hit above = rays.trace(standing.place, {0, 1, 0});
        if (above.met()) {
            heights.push_back(eye_height + above.distance);
        }
    }
    if (heights.empty()) {
        return 1.0F;
    }
    std::sort(heights.begin(), heights.end());
    const float low = heights[heights.size() / 4];
    return low > highest_hall ? heights[heights.size() / 2] / usual_room : 1.0F;
}

}  // namespace

std::vector<Camera> standing_views(const Scene& scene, const WorldRays& rays, std::size_t most) {
    std::vector<Standing> found = Finder(scene, rays, 1.0F).all();
    const float metre = likely_metre(rays, found);
    if (metre > 1.0F) {
        found = Finder(scene, rays, metre).all();
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const Standing& a, const Standing& b) { return a.worth > b.worth; });
    std::vector<Camera> views;
    for (const Standing& standing : found) {
        const auto seen = [&](const Camera& other) {
            return glm::distance(other.eye, standing.camera.eye) < least_apart * metre ||
                   !rays.blocked(other.eye, standing.camera.eye);
        };
        if (views.size() < most && std::none_of(views.begin(), views.end(), seen)) {
            views.push_back(standing.camera);
            views.back().name =
                views.size() == 1 ? "inside" : fmt::format("inside {}", views.size());
        }
    }
    return views;
}

}  // namespace raybundle
