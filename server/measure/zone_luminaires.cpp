// SPDX-License-Identifier: Apache-2.0
#include "measure/zone_luminaires.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include "measure/solid_test.h"
#include "reference/sampling/pane_shares.h"
#include "scene/edit/light_edit.h"

namespace raybundle {
namespace {

constexpr std::size_t most_places = 32;
constexpr std::size_t paths_each = 4;  // from each place
/// Lamps times places: shadow rays of 50 ms on one core.
constexpr std::size_t most_shadow_rays = 1U << 16U;
constexpr int emitter_points = 8;

double brought_by(const glm::dvec3& colour) {
    return static_cast<double>(luminance(glm::vec3(colour)));
}

/// What each lamp brings, by its number on the wire.
class LampLight {
  public:
    explicit LampLight(const MeasuredScene& scene) : scene_(scene), rays_(scene.rays) {
        const Scene& all = rays_.scene();
        for (std::size_t i = 0; i < all.punctual_lights.size(); ++i) {
            const PunctualLight& light = all.punctual_lights[i];
            if (light.kind != PunctualKind::directional && light.intensity != glm::vec3(0.0F)) {
                const std::uint32_t number = punctual_number(all, i);
                lamps_.push_back({place_light(all, light), number});
                known_[number] = {number, light.name, 0.0, colour_rendering_of(light)};
            }
        }
        for (const Light& light : all.lights) {
            if (light.material >= 0) {
                light_of_material_[light.material] = light.id;
                known_[light.id] = {light.id, light.name, 0.0, colour_rendering_of(light.control)};
            }
        }
    }

    [[nodiscard]] std::size_t lamps() const { return lamps_.size(); }

    /// weight: of light from a unit direction. factor: of all that arrives.
    void gather(const glm::dvec3& position, const std::function<double(const glm::dvec3&)>& weight,
                double factor, Sampler& sampler) {
        for (const Lamp& lamp : lamps_) {
            const glm::dvec3 there =
                rays_.from_world(lamp.placed.has_opening() ? lamp.placed.point(sampler.next_pair())
                                                           : lamp.placed.position);
            const glm::dvec3 offset = there - position;
            const double square = glm::dot(offset, offset);
            const glm::dvec3 direction =
                square > 0.0 ? offset / std::sqrt(square) : glm::dvec3(0.0);
            const double brought = square > 0.0 ? factor * weight(direction) : 0.0;
            const glm::dvec3 intensity = lamp.placed.towards(-direction);
            if (brought > 0.0 && intensity != glm::dvec3(0.0)) {
                known_[lamp.number].share +=
                    brought / (square * rays_.square_metres()) *
                    brought_by(intensity * share_through_panes(rays_, position, there));
            }
        }
        gather_from_surfaces(position, weight, factor, sampler);
    }

    /// Those that bring `part` of all, with their shares.
    [[nodiscard]] std::vector<ZoneLuminaire> strongest(double part) const {
        std::vector<ZoneLuminaire> result;
        double all = 0.0;
        for (const auto& [number, luminaire] : known_) {
            if (luminaire.share > 0.0) {
                result.push_back(luminaire);
                all += luminaire.share;
            }
        }
        std::stable_sort(result.begin(), result.end(),
                         [](const auto& a, const auto& b) { return a.share > b.share; });
        double sum = 0.0;
        std::size_t count = 0;
        for (; count < result.size() && sum < part; ++count) {
            result[count].share /= all;
            sum += result[count].share;
        }
        result.resize(count);
        return result;
    }

  private:
    struct Lamp {
        PlacedLight placed;
        std::uint32_t number;
    };

    void gather_from_surfaces(const glm::dvec3& position,
                              const std::function<double(const glm::dvec3&)>& weight, double factor,
                              Sampler& sampler) {
        SurfacePoint at;
        at.position = position;
        const double choice = sampler.next();
        for (int i = 0; i < emitter_points && scene_.lights.has_emitters(); ++i) {
            const auto light = scene_.lights.sample_emitter(at, (i + choice) / emitter_points,
                                                            sampler.next_pair());
            const double brought = light ? factor * weight(light->direction) : 0.0;
            if (!(brought > 0.0)) {
                continue;
            }
            const auto number = light_of_material_.find(
                static_cast<int>(rays_.mesh().triangle_material[light->emitter->triangle]));
            if (number != light_of_material_.end()) {
                known_[number->second].share +=
                    brought / (emitter_points * light->density) *
                    brought_by(
                        light->radiance *
                        share_through_panes(rays_, position, rays_.departure(*light->emitter)));
            }
        }
    }

    const MeasuredScene& scene_;
    const RayScene& rays_;
    std::vector<Lamp> lamps_;
    std::map<std::uint32_t, ZoneLuminaire> known_;
    std::map<int, std::uint32_t> light_of_material_;
};

/// Where light comes in at a point, as where it is measured.
glm::dvec3 place_of(const MeasuredScene& scene, const CalculationPoint& point, Quantity quantity) {
    return in_front_of_surface(scene.rays, scene.rays.from_world(point.position),
                               Receiver(quantity, point.direction).axis());
}

/// Evenly among the points, those in solids left out.
std::vector<std::size_t> places_among(const MeasuredScene& scene,
                                      std::span<const CalculationPoint> points, Quantity quantity,
                                      std::size_t wanted) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < std::min(points.size(), wanted); ++i) {
        const std::size_t point =
            (2 * i + 1) * points.size() / (2 * std::min(points.size(), wanted));
        if (!inside_solid(scene.rays, place_of(scene, points[point], quantity))) {
            places.push_back(point);
        }
    }
    return places;
}

}  // namespace

std::vector<ZoneLuminaire> find_zone_luminaires(const MeasuredScene& scene,
                                                std::span<const CalculationPoint> points,
                                                Quantity quantity, bool direct) {
    constexpr double part = 0.98;
    LampLight light(scene);
    const std::size_t each =
        std::max<std::size_t>(light.lamps(), 1) * (direct ? 1 : 1 + paths_each);
    const std::size_t wanted = std::clamp<std::size_t>(most_shadow_rays / each, 4, most_places);
    for (const std::size_t point : places_among(scene, points, quantity, wanted)) {
        const Receiver receiver(quantity, points[point].direction);
        const glm::dvec3 position = place_of(scene, points[point], quantity);
        for (std::uint32_t path = 0; path < paths_each; ++path) {
            PixelSampler sampler(1, static_cast<std::uint32_t>(point), 0, path);
            if (path == 0) {
                light.gather(
                    position, [&](const glm::dvec3& to) { return receiver.weight(to); }, paths_each,
                    sampler);
            }
            const glm::dvec3 direction = receiver.sample(sampler);
            const auto hit = direct ? std::nullopt : scene.rays.trace(position, direction);
            if (hit && !hit->absorbs()) {
                const glm::vec3 reflectance = scene.rays.base_colour(*hit);
                // Of what the path brings, pi times the radiance that the surface reflects.
                light.gather(
                    scene.rays.departure(*hit),
                    [&](const glm::dvec3& to) { return std::max(glm::dot(to, hit->normal), 0.0); },
                    static_cast<double>(luminance(reflectance)), sampler);
            }
        }
    }
    return light.strongest(part);
}

}  // namespace raybundle
