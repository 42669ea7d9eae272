// SPDX-License-Identifier: Apache-2.0
#include "reference/air_ways.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reference/sampling/pane_shares.h"

namespace raybundle {
namespace {

constexpr double to_the_sky = std::numeric_limits<double>::infinity();

/// A direction within a disc about another, evenly as a surface across it receives light.
glm::dvec3 in_sun_disc(const glm::dvec3& centre, double radius, const glm::dvec2& at) {
    const double from_axis = std::sin(radius) * std::sqrt(at.y);
    return Frame(centre).to_world({from_axis * std::cos(2.0 * std::numbers::pi * at.x),
                                   from_axis * std::sin(2.0 * std::numbers::pi * at.x),
                                   std::sqrt(1.0 - from_axis * from_axis)});
}

/// What a light could send through the scene, own space; for the choice among lights.
double flux_into(const RayScene& scene, const PlacedLight& light) {
    if (light.kind == PunctualKind::directional) {
        return std::numbers::pi * scene.diameter() * scene.diameter() *
               static_cast<double>(luminance(glm::vec3(light.intensity)));
    }
    return static_cast<double>(luminance(glm::vec3(light.flux()))) / scene.square_metres();
}

}  // namespace

AirWays::AirWays(const RayScene& scene, const LightSampling& lights, Panes panes)
    : scene_(scene),
      lights_(lights),
      panes_(panes),
      medium_(*scene.scene().medium),
      extinction_(medium_.extinction * std::sqrt(scene.square_metres())),
      low_(scene.from_world(scene.scene().bounds.min)),
      high_(scene.from_world(scene.scene().bounds.max)) {
    std::vector<double> fluxes;
    for (const PunctualLight& light : scene.scene().punctual_lights) {
        punctual_.push_back(place_light(scene.scene(), light));
        fluxes.push_back(flux_into(scene, punctual_.back()));
    }
    choice_ = DiscreteDistribution(fluxes);
}

WayInBox AirWays::way(const glm::dvec3& origin, const glm::dvec3& direction,
                      const std::optional<SurfacePoint>& hit) const {
    const double end = hit ? glm::distance(origin, hit->position) : to_the_sky;
    return way_in_box(low_, high_, origin, direction, end);
}

double AirWays::transmittance(double length) const {
    return std::exp(-extinction_ * length);
}

double AirWays::transmittance_between(const glm::dvec3& a, const glm::dvec3& b) const {
    const double distance = glm::distance(a, b);
    return distance > 0.0
               ? transmittance(way_in_box(low_, high_, a, (b - a) / distance, distance).length())
               : 1.0;
}

double AirWays::transmittance_to_sky(const glm::dvec3& from, const glm::dvec3& direction) const {
    return transmittance(way_in_box(low_, high_, from, direction, to_the_sky).length());
}

double AirWays::transmittance_of(const glm::dvec3& from, const LightSample& light) const {
    if (light.origin) {
        return transmittance_between(from, *light.origin);
    }
    return light.emitter ? transmittance_between(from, light.emitter->position)
                         : transmittance_to_sky(from, light.direction);
}

std::optional<double> AirWays::collision(const WayInBox& way, double u) const {
    const double free = -std::log(1.0 - u) / extinction_;
    if (!(free < way.length())) {
        return std::nullopt;
    }
    return way.begin + free;
}

AirWays::Place AirWays::place_towards(const glm::dvec3& light, const glm::dvec3& origin,
                                      const glm::dvec3& direction, const WayInBox& way,
                                      double u) const {
    constexpr double least_distance = 1e-12;
    const double nearest = glm::dot(light - origin, direction);
    const double aside =
        std::max(glm::distance(light, origin + nearest * direction), least_distance);
    const double first = std::atan((way.begin - nearest) / aside);
    const double last = std::atan((way.end - nearest) / aside);
    const double along = aside * std::tan(first + u * (last - first));
    const double distance = std::clamp(nearest + along, way.begin, way.end);
    return {distance, aside / ((last - first) * (aside * aside + along * along))};
}

AirWays::Place AirWays::place_by_extinction(const WayInBox& way, double u) const {
    const double most = 1.0 - transmittance(way.length());
    const double free = -std::log1p(-u * most) / extinction_;
    return {way.begin + free, extinction_ * transmittance(free) / most};
}

/// Illuminance (lx) at a point of a surface that faces the light, after all air and obstacles.
glm::dvec3 AirWays::reaching(const PlacedLight& light, const glm::dvec3& at, const glm::dvec2& u,
                             glm::dvec3& to_light) const {
    if (light.kind == PunctualKind::directional) {
        to_light = light.angular_radius > 0.0
                       ? in_sun_disc(-light.direction(), light.angular_radius, u)
                       : -light.direction();
        const glm::dvec3 share =
            panes_ == Panes::pass
                ? share_through_panes_from_sky(scene_, at, to_light)
                : glm::dvec3(scene_.open_towards(glm::vec3(at), to_light) ? 1.0 : 0.0);
        return share * light.intensity * transmittance_to_sky(at, to_light);
    }
    const glm::dvec3 there = scene_.from_world(light.point(u));
    const double distance = glm::distance(at, there);
    if (!(distance > 0.0)) {
        return glm::dvec3(0.0);
    }
    to_light = (there - at) / distance;
    const glm::dvec3 sent = light.towards(-to_light);
    if (sent == glm::dvec3(0.0)) {
        return sent;
    }
    const glm::dvec3 share =
        panes_ == Panes::pass
            ? share_through_panes(scene_, at, there)
            : glm::dvec3(scene_.unobstructed(glm::vec3(at), glm::vec3(there)) ? 1.0 : 0.0);
    return share * sent *
           (transmittance_between(at, there) / (distance * distance * scene_.square_metres()));
}

glm::dvec3 AirWays::punctual(const glm::dvec3& origin, const glm::dvec3& direction,
                             const WayInBox& way, Sampler& sampler) const {
    if (punctual_.empty() || !(way.length() > 0.0) || choice_.empty()) {
        return glm::dvec3(0.0);
    }
    const std::size_t chosen = choice_.sample(sampler.next());
    const double u = sampler.next();
    const glm::dvec2 in_light = sampler.next_pair();
    const PlacedLight& light = punctual_[chosen];
    const Place place =
        light.kind == PunctualKind::directional
            ? place_by_extinction(way, u)
            : place_towards(scene_.from_world(light.point(in_light)), origin, direction, way, u);
    if (!(place.density > 0.0)) {
        return glm::dvec3(0.0);
    }
    glm::dvec3 to_light(0.0);
    const glm::dvec3 light_there =
        reaching(light, origin + place.distance * direction, in_light, to_light);
    if (light_there == glm::dvec3(0.0)) {
        return light_there;
    }
    const double scattered = extinction_ * transmittance(place.distance - way.begin) *
                             phase_of(medium_.anisotropy, glm::dot(to_light, direction));
    return glm::dvec3(medium_.albedo) * light_there *
           (scattered / (place.density * choice_.probability(chosen)));
}

glm::dvec3 AirWays::emitters(const AirVertex& at, Sampler& sampler) const {
    if (!lights_.has_emitters()) {
        return glm::dvec3(0.0);
    }
    SurfacePoint from;
    from.position = at.position;
    const double choice = sampler.next();
    const auto light = lights_.sample_emitter(from, choice, sampler.next_pair());
    if (!light || !scene_.unobstructed(glm::vec3(at.position), scene_.departure(*light->emitter))) {
        return glm::dvec3(0.0);
    }
    const double phase = phase_of(medium_.anisotropy, glm::dot(light->direction, at.along));
    return light->radiance * (transmittance_of(at.position, *light) * phase / light->density *
                              power_heuristic(light->density, phase));
}

double AirWays::emitter_density(const AirVertex& at, const glm::dvec3& direction,
                                const std::optional<SurfacePoint>& hit) const {
    if (!hit) {
        return 0.0;
    }
    SurfacePoint from;
    from.position = at.position;
    return lights_.emitter_density(from, direction, *hit);
}

}  // namespace raybundle
