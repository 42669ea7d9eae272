// SPDX-License-Identifier: Apache-2.0
#include "solution/specular/caustic_lights.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>

#include "scene/mesh/patch_colour.h"

namespace raybundle {

glm::mat3 frame_about(const glm::vec3& z) {
    const float sign = std::copysign(1.0F, z.z);
    const float a = -1.0F / (sign + z.z);
    const float b = z.x * z.y * a;
    return {
        {1.0F + sign * z.x * z.x * a, sign * b, -sign * z.x}, {b, sign + z.y * z.y * a, -z.y}, z};
}

namespace {

constexpr std::size_t most_targets = 16;
constexpr float least_share = 1e-3F;       // of a lamp's flux: none is starved
constexpr float margin = 1.001F;           // of a sphere's radius
constexpr float start_share = 0x1.0p-18F;  // of the diameter
constexpr std::size_t sky_rows = 32;       // cells of equal solid angle
constexpr std::size_t sky_columns = 64;
constexpr std::size_t sky_cells = sky_rows * sky_columns;

/// Direction to a place of a cell of the sky, whose coordinates are in [0, 1).
glm::vec3 direction_in_sky(std::size_t cell, float along, float across) {
    const std::size_t row = cell / sky_columns;
    const float height = 1.0F - 2.0F * (static_cast<float>(row) + along) / float{sky_rows};
    const float sine = std::sqrt(std::max(1.0F - height * height, 0.0F));
    const float turn = glm::two_pi<float>() * (static_cast<float>(cell % sky_columns) + across) /
                       float{sky_columns};
    return {sine * std::cos(turn), height, sine * std::sin(turn)};
}

glm::vec3 on_cone(const glm::vec3& axis, float cosine, float turn) {
    const float sine = std::sqrt(std::max(1.0F - cosine * cosine, 0.0F));
    const float angle = glm::two_pi<float>() * turn;
    return glm::normalize(frame_about(axis) *
                          glm::vec3(sine * std::cos(angle), sine * std::sin(angle), cosine));
}

/// 1 - cosine of a cone that holds a sphere, from outside of it: exact for small ones.
float cone_height(float radius, float square) {
    const float sine2 = std::min(radius * radius / square, 1.0F);
    return sine2 / (1.0F + std::sqrt(1.0F - sine2));
}

}  // namespace

CausticLights::CausticLights(const GpuScene& scene, const PatchMesh& mesh,
                             std::span<const glm::vec3> radiance, Kind kind,
                             std::span<const Bounds> targets)
    : scene_(scene), diameter_(scene.diameter()), offset_(start_share * scene.diameter()) {
    std::vector<Bounds> boxes(targets.begin(), targets.end());
    for (std::size_t i = most_targets; i < boxes.size(); ++i) {
        boxes[most_targets - 1].add(boxes[i].min);
        boxes[most_targets - 1].add(boxes[i].max);
    }
    boxes.resize(std::min(boxes.size(), most_targets));
    for (const Bounds& box : boxes) {
        targets_.push_back({box.centre(), 0.5F * margin * glm::length(box.extent())});
    }
    add_emitters(scene, mesh, radiance);
    if (kind == Kind::lamps) {
        add_punctual();
    } else if (scene.has_sky()) {
        add_sky();
    }
    for (double& chance : chances_) {
        chance /= std::max(chances_.back(), 1e-300);
    }
}

/// Of all targets as anything far away sees them, m².
double CausticLights::target_discs() const {
    double area = 0.0;
    for (const Sphere& sphere : targets_) {
        const auto r = static_cast<double>(sphere.radius);
        area += glm::pi<double>() * r * r;
    }
    return area;
}

void CausticLights::add_sky() {
    const double unit = static_cast<double>(scene_.radiance_unit());
    const double share = 4.0 * glm::pi<double>() / double{sky_cells} * target_discs();
    std::vector<double> fluxes;
    for (std::size_t cell = 0; cell < sky_cells; ++cell) {
        const glm::vec3 radiance = scene_.sky_towards(direction_in_sky(cell, 0.5F, 0.5F));
        fluxes.push_back(static_cast<double>(luminance(radiance)) * unit * share);
    }
    const double all = std::accumulate(fluxes.begin(), fluxes.end(), 0.0);
    for (const double flux : fluxes) {  // a tenth evenly: a cell's centre does not tell all of it
        add_chance(0.9 * flux + 0.1 * all / double{sky_cells});
    }
}

void CausticLights::add_punctual() {
    for (std::size_t i = 0; i < scene_.punctual_lights().size(); ++i) {
        const PlacedLight light = scene_.placed_light(i);
        punctual_.push_back(light);
        double flux = 0.0;
        if (light.kind == PunctualKind::directional) {
            flux = target_discs() * static_cast<double>(luminance(glm::vec3(light.intensity)));
        } else {
            flux = static_cast<double>(luminance(glm::vec3(light.flux())) *
                                       reachable_share(glm::vec3(light.position)));
        }
        add_chance(flux);
    }
}

void CausticLights::add_chance(double flux) {
    chances_.push_back((chances_.empty() ? 0.0 : chances_.back()) + flux);
}

void CausticLights::add_emitters(const GpuScene& scene, const PatchMesh& mesh,
                                 std::span<const glm::vec3> radiance) {
    for (std::size_t i = 0; i < mesh.side_count(); ++i) {
        if (luminance(radiance[i]) <= 0.0F) {
            continue;
        }
        const glm::uvec3& t = mesh.triangles[mesh.side_triangle[i]];
        const glm::mat4 world = scene.world_from_object(mesh.vertex_object[t.x], Place::now);
        const auto corner = [&](std::uint32_t vertex) {
            return glm::vec3(world * glm::vec4(mesh.positions[vertex], 1.0F));
        };
        Emitter emitter;
        emitter.a = corner(t.x);
        emitter.e1 = corner(t.y) - emitter.a;
        emitter.e2 = corner(t.z) - emitter.a;
        const glm::vec3 across = glm::cross(emitter.e1, emitter.e2);
        const float size = glm::length(across);
        if (!(size > 0.0F)) {
            continue;
        }
        const bool back = i >= mesh.triangle_count();
        const bool mirrored = glm::determinant(glm::mat3(world)) < 0.0F;
        emitter.normal = across * ((back != mirrored ? -1.0F : 1.0F) / size);
        emitter.flux_density = radiance[i] * (0.5F * size);
        emitters_.push_back(emitter);
        add_chance(
            static_cast<double>(luminance(emitter.flux_density) *
                                reachable_share(emitter.a + (emitter.e1 + emitter.e2) / 3.0F)));
    }
}

float CausticLights::solid_angle(const Sphere& sphere, const glm::vec3& origin) const {
    const glm::vec3 offset = sphere.centre - origin;
    const float square = glm::dot(offset, offset);
    if (square <= sphere.radius * sphere.radius) {
        return glm::two_pi<float>();
    }
    return glm::two_pi<float>() * cone_height(sphere.radius, square);
}

float CausticLights::reachable_share(const glm::vec3& origin) const {
    float sum = 0.0F;
    for (const Sphere& sphere : targets_) {
        sum += solid_angle(sphere, origin);
    }
    return std::clamp(sum / glm::two_pi<float>(), least_share, 1.0F);
}

/// Towards one of the targets, by their solid angles. From within its sphere: by the cosine with
/// `normal`, or anywhere where there is none.
CausticLights::Aim CausticLights::aim(const glm::vec3& origin, const glm::vec3* normal,
                                      const Numbers& numbers) const {
    float all = 0.0F;
    for (const Sphere& sphere : targets_) {
        all += solid_angle(sphere, origin);
    }
    Aim aim;
    float left = numbers[3] * all;
    const Sphere* chosen = nullptr;
    for (const Sphere& sphere : targets_) {
        const float part = solid_angle(sphere, origin);
        if (part > 0.0F && (chosen == nullptr || left >= 0.0F)) {
            chosen = &sphere;
        }
        left -= part;
    }
    if (chosen == nullptr) {
        return aim;
    }
    const glm::vec3 offset = chosen->centre - origin;
    const float square = glm::dot(offset, offset);
    if (square > chosen->radius * chosen->radius) {
        const float height = cone_height(chosen->radius, square);
        aim.direction = on_cone(offset / std::sqrt(square), 1.0F - numbers[4] * height, numbers[5]);
    } else if (normal != nullptr) {
        aim.direction = on_cone(*normal, std::sqrt(1.0F - numbers[4]), numbers[5]);
    } else {
        aim.direction = on_cone({0.0F, 0.0F, 1.0F}, 1.0F - 2.0F * numbers[4], numbers[5]);
    }
    for (const Sphere& sphere : targets_) {
        const glm::vec3 to = sphere.centre - origin;
        const float far = glm::dot(to, to);
        if (far > sphere.radius * sphere.radius) {
            const float cosine = glm::dot(to, aim.direction) / std::sqrt(far);
            aim.density += 1.0F - cosine <= cone_height(sphere.radius, far) ? 1.0F / all : 0.0F;
        } else {
            const float share =
                normal != nullptr
                    ? std::max(glm::dot(*normal, aim.direction), 0.0F) / glm::pi<float>()
                    : 0.25F / glm::pi<float>();
            aim.density += share * glm::two_pi<float>() / all;
        }
    }
    return aim;
}

std::optional<LightRay> CausticLights::from_emitter(const Emitter& emitter, double chance,
                                                    const Numbers& numbers) const {
    const float root = std::sqrt(numbers[1]);
    LightRay ray;
    ray.origin = emitter.a + root * (1.0F - numbers[2]) * emitter.e1 +
                 root * numbers[2] * emitter.e2 + offset_ * emitter.normal;
    const Aim aimed = aim(ray.origin, &emitter.normal, numbers);
    const float cosine = glm::dot(aimed.direction, emitter.normal);
    if (cosine <= 0.0F || aimed.density <= 0.0F) {
        return std::nullopt;
    }
    ray.direction = aimed.direction;
    ray.flux = emitter.flux_density * (cosine / (aimed.density * static_cast<float>(chance)));
    return ray;
}

std::optional<LightRay> CausticLights::from_point(const PlacedLight& light, double chance,
                                                  const Numbers& numbers) const {
    LightRay ray;
    ray.punctual = true;
    ray.origin = glm::vec3(light.point({numbers[1], numbers[2]}));
    const Aim aimed = aim(ray.origin, nullptr, numbers);
    if (aimed.density <= 0.0F) {
        return std::nullopt;
    }
    ray.direction = aimed.direction;
    ray.flux = glm::vec3(light.towards(glm::dvec3(aimed.direction))) /
               (aimed.density * static_cast<float>(chance));
    return ray.flux == glm::vec3(0.0F) ? std::nullopt : std::optional(ray);
}

/// On a point of one of the targets' discs. radiance: over the density of the direction, or the
/// illuminance of what shines from that direction alone.
LightRay CausticLights::from_outside(const glm::vec3& direction, const glm::vec3& radiance,
                                     const Numbers& numbers) const {
    const auto all = static_cast<float>(target_discs());
    const Sphere* chosen = &targets_.front();
    float left = numbers[3] * all;
    for (const Sphere& sphere : targets_) {
        chosen = left >= 0.0F ? &sphere : chosen;
        left -= glm::pi<float>() * sphere.radius * sphere.radius;
    }
    LightRay ray;
    ray.direction = direction;
    const glm::mat3 frame = frame_about(ray.direction);
    const float angle = glm::two_pi<float>() * numbers[5];
    const glm::vec3 at =
        chosen->centre + chosen->radius * std::sqrt(numbers[4]) *
                             (std::cos(angle) * frame[0] + std::sin(angle) * frame[1]);
    float discs = 0.0F;
    for (const Sphere& sphere : targets_) {
        const glm::vec3 offset = at - sphere.centre;
        const glm::vec3 across = offset - glm::dot(offset, ray.direction) * ray.direction;
        discs += glm::dot(across, across) <= sphere.radius * sphere.radius ? 1.0F : 0.0F;
    }
    ray.origin = at - 2.0F * diameter_ * ray.direction;
    ray.flux = radiance * (all / std::max(discs, 1.0F));
    return ray;
}

std::optional<LightRay> CausticLights::from_far(const PlacedLight& light, double chance,
                                                const Numbers& numbers) const {
    LightRay ray = from_outside(glm::normalize(glm::vec3(light.direction())),
                                glm::vec3(light.intensity) / static_cast<float>(chance), numbers);
    ray.punctual = true;
    return ray;
}

std::optional<LightRay> CausticLights::from_sky(std::size_t cell, double chance,
                                                const Numbers& numbers) const {
    const glm::vec3 towards = direction_in_sky(cell, numbers[1], numbers[2]);
    const glm::vec3 radiance = scene_.sky_towards(towards) * scene_.radiance_unit();
    if (radiance == glm::vec3(0.0F)) {
        return std::nullopt;
    }
    const float solid_angle = 4.0F * glm::pi<float>() / float{sky_cells};
    return from_outside(-towards, radiance * (solid_angle / static_cast<float>(chance)), numbers);
}

std::optional<LightRay> CausticLights::ray(const Numbers& numbers) const {
    if (empty() || targets_.empty()) {
        return std::nullopt;
    }
    const auto found =
        std::upper_bound(chances_.begin(), chances_.end() - 1, static_cast<double>(numbers[0]));
    const auto index = static_cast<std::size_t>(found - chances_.begin());
    const double chance = chances_[index] - (index > 0 ? chances_[index - 1] : 0.0);
    if (!(chance > 0.0)) {
        return std::nullopt;
    }
    if (index < emitters_.size()) {
        return from_emitter(emitters_[index], chance, numbers);
    }
    if (punctual_.empty()) {
        return from_sky(index - emitters_.size(), chance, numbers);
    }
    const PlacedLight& light = punctual_[index - emitters_.size()];
    return light.kind == PunctualKind::directional ? from_far(light, chance, numbers)
                                                   : from_point(light, chance, numbers);
}

}  // namespace raybundle
