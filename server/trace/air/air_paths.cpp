// SPDX-License-Identifier: Apache-2.0
#include "trace/air/air_paths.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/light/environment.h"

namespace raybundle {
namespace {

constexpr double to_the_sky = std::numeric_limits<double>::infinity();
constexpr int most_collisions = 4096;
constexpr int certain_collisions = 4;  // before Russian roulette

}  // namespace

AirPaths::AirPaths(const Parts& parts)
    : parts_(parts), medium_(parts.medium), low_(parts.box.min), high_(parts.box.max) {}

WayInBox AirPaths::way(const glm::vec3& origin, const glm::vec3& direction, double end) const {
    return way_in_box(low_, high_, glm::dvec3(origin), glm::dvec3(direction), end);
}

AirPaths::Place AirPaths::place_towards(const glm::vec3& light, const glm::vec3& origin,
                                        const glm::vec3& direction, const WayInBox& way,
                                        double u) const {
    constexpr double least_distance = 1e-9;
    const glm::dvec3 towards = glm::dvec3(light) - glm::dvec3(origin);
    const double nearest = glm::dot(towards, glm::dvec3(direction));
    const double aside =
        std::max(glm::length(towards - nearest * glm::dvec3(direction)), least_distance);
    const double first = std::atan((way.begin - nearest) / aside);
    const double last = std::atan((way.end - nearest) / aside);
    const double along = aside * std::tan(first + u * (last - first));
    if (!(last > first)) {
        return {};
    }
    return {std::clamp(nearest + along, way.begin, way.end),
            aside / ((last - first) * (aside * aside + along * along))};
}

AirPaths::Place AirPaths::place_by_extinction(const WayInBox& way, double u) const {
    const double most = opacity(way);
    const double free = -std::log1p(-u * most) / medium_.extinction;
    return {way.begin + free, medium_.extinction * medium_.left_after(free) / most};
}

/// What a chosen light sends to a place in the air and is scattered there against a ray, over the
/// density of the choice; scattering per metre left out.
glm::dvec3 AirPaths::arriving(const AirLight& light, const glm::vec3& at, const glm::vec3& eye_ray,
                              AirRandom& random) const {
    if (light.distant) {
        const double phase =
            phase_of(medium_.anisotropy, static_cast<double>(glm::dot(light.direction, eye_ray)));
        if (!parts_.surfaces.open_towards(at, light.direction, random)) {
            return glm::dvec3(0.0);
        }
        return light.punctual->intensity *
               (phase * medium_.left_after(way(at, light.direction, to_the_sky).length()) /
                light.density);
    }
    glm::vec3 target = light.position;
    if (light.punctual == nullptr) {
        target += parts_.surfaces.lift() * light.direction;
    }
    const glm::vec3 offset = target - at;
    const auto square = static_cast<double>(glm::dot(offset, offset));
    if (!(square > 0.0) || !(light.density > 0.0)) {
        return glm::dvec3(0.0);
    }
    const double distance = std::sqrt(square);
    const glm::vec3 to_light = offset / static_cast<float>(distance);
    glm::dvec3 intensity(0.0);
    if (light.punctual != nullptr) {
        intensity = light.punctual->towards(-glm::dvec3(to_light));
    } else {
        const auto cosine = static_cast<double>(-glm::dot(to_light, light.direction));
        intensity = std::max(cosine, 0.0) * glm::dvec3(light.radiance);
    }
    if (intensity == glm::dvec3(0.0) || !parts_.surfaces.open(at, target, random)) {
        return glm::dvec3(0.0);
    }
    const double phase =
        phase_of(medium_.anisotropy, static_cast<double>(glm::dot(to_light, eye_ray)));
    return intensity * (phase * medium_.left_after(way(at, to_light, distance).length()) /
                        (square * light.density));
}

/// Light of lamps that is scattered once, along a ray.
glm::dvec3 AirPaths::lamps_along(const glm::vec3& origin, const glm::vec3& direction,
                                 const WayInBox& way, AirRandom& random) const {
    if (parts_.lights.empty() || !(way.length() > 0.0)) {
        return glm::dvec3(0.0);
    }
    const AirLight light = parts_.lights.choose(random);
    const double u = random.next();
    const Place place = light.distant ? place_by_extinction(way, u)
                                      : place_towards(light.position, origin, direction, way, u);
    if (!(place.density > 0.0)) {
        return glm::dvec3(0.0);
    }
    const glm::vec3 at = origin + static_cast<float>(place.distance) * direction;
    return glm::dvec3(medium_.albedo) * arriving(light, at, direction, random) *
           (medium_.extinction * medium_.left_after(place.distance - way.begin) / place.density);
}

AirEstimate AirPaths::along(const glm::vec3& origin, const glm::vec3& direction, double end,
                            AirRandom& random) const {
    AirEstimate sum;
    WayInBox air = way(origin, direction, end);
    if (!(air.length() > 0.0)) {
        return sum;
    }
    sum.lamps = lamps_along(origin, direction, air, random);
    // The first collision is certain; what it is worth is the way's opacity.
    glm::dvec3 throughput = opacity(air) * glm::dvec3(medium_.albedo);
    glm::vec3 at =
        origin + static_cast<float>(place_by_extinction(air, random.next()).distance) * direction;
    glm::dvec3 towards(direction);
    for (int i = 0; i < most_collisions && throughput != glm::dvec3(0.0); ++i) {
        const double u = random.next();
        towards = scattered_direction(medium_.anisotropy, towards, {u, random.next()});
        const glm::vec3 ray(towards);
        const std::optional<AirScene::Hit> hit = parts_.surfaces.meet(at, ray, random);
        air = way(at, ray, hit ? static_cast<double>(hit->distance) : to_the_sky);
        sum.lamps += throughput * lamps_along(at, ray, air, random);
        const double free = -std::log1p(-random.next()) / medium_.extinction;
        if (!(free < air.length())) {
            if (!hit) {
                sum.lamps += throughput * sky_towards(parts_.scene, towards);
            } else if (hit->patch != PatchMesh::no_patch && !parts_.reflected.empty()) {
                sum.surfaces += throughput * glm::dvec3(parts_.reflected[hit->patch]);
            }
            break;
        }
        at += static_cast<float>(air.begin + free) * ray;
        throughput *= glm::dvec3(medium_.albedo);
        if (i >= certain_collisions) {
            const double chance =
                std::min(std::max({throughput.r, throughput.g, throughput.b}), 1.0);
            if (random.next() >= chance) {
                break;
            }
            throughput /= chance;
        }
    }
    return sum;
}

}  // namespace raybundle
