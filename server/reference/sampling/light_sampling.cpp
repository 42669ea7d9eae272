// SPDX-License-Identifier: Apache-2.0
#include "reference/sampling/light_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "reference/sampling/pane_shares.h"
#include "scene/light/environment.h"

namespace raybundle {
namespace {

using std::numbers::pi;
/// Where both exist, the sky and the emitters each get at least this share of the samples: power
/// alone says nothing about which of them a point can see.
constexpr double least_share = 0.25;

/// Share of the choice among emitters that goes by area.
constexpr double defensive_share = 0.1;

/// Of more punctual lights than these it would take longer to compare them than to trace rays.
constexpr std::size_t most_compared = 64;

/// Share of the samples that goes to the sky. emitted: power of all emitters, own space.
double sky_share(const RayScene& scene, double emitted) {
    const double luminance = raybundle::luminance(glm::vec3(mean_sky(scene.scene())));
    if (!(luminance > 0.0)) {
        return 0.0;
    }
    if (!(emitted > 0.0)) {
        return 1.0;
    }
    // Flux through a sphere round the scene: pi L times its surface, pi diameter^2.
    const double diameter = scene.diameter();
    const double flux = pi * luminance * pi * diameter * diameter;
    return std::clamp(flux / (flux + emitted), least_share, 1.0 - least_share);
}

/// Flux of a light into the scene, cd/m² times own area; of a directional one through the scene's
/// bounding sphere.
double flux_of(const RayScene& scene, const PlacedLight& light) {
    if (light.kind != PunctualKind::directional) {
        return luminance(glm::vec3(light.flux())) / scene.square_metres();
    }
    return 0.25 * pi * scene.diameter() * scene.diameter() * luminance(glm::vec3(light.intensity));
}

/// A direction within a disc about another, evenly as a surface across it receives light.
glm::dvec3 in_disc(const glm::dvec3& centre, double radius, const glm::dvec2& at) {
    const double from_axis = std::sin(radius) * std::sqrt(at.y);
    const double angle = 2.0 * pi * at.x;
    return Frame(centre).to_world({from_axis * std::cos(angle), from_axis * std::sin(angle),
                                   std::sqrt(1.0 - from_axis * from_axis)});
}

/// Directions of a light with a position are drawn evenly within a cone of this solid angle, sr.
double solid_angle_of(const PlacedLight& light) {
    return 2.0 * pi * (light.kind == PunctualKind::spot ? 1.0 - light.outer_cosine : 2.0);
}

}  // namespace

std::optional<SurfacePoint> first_hit(const RayScene& scene, const EmittedParticle& particle) {
    return particle.emitter ? scene.trace_from(*particle.emitter, particle.direction)
                            : scene.trace(particle.origin, particle.direction);
}

LightSampling::LightSampling(const RayScene& scene)
    : scene_(scene), density_per_area_(scene.mesh().side_count(), 0.0), sky_(scene.scene()) {
    std::vector<double> powers;
    double total_power = 0.0;
    double total_area = 0.0;
    for (std::uint32_t patch = 0; patch < scene.mesh().side_count(); ++patch) {
        const double area = scene.patch_area(patch);
        const double power = pi * area * luminance(scene.mesh().emission[patch]);
        if (power > 0.0) {
            patches_.push_back(patch);
            powers.push_back(power);
            total_power += power;
            total_area += area;
        }
    }
    std::vector<double> weights;
    weights.reserve(patches_.size());
    for (std::size_t i = 0; i < patches_.size(); ++i) {
        weights.push_back((1.0 - defensive_share) * powers[i] / total_power +
                          defensive_share * scene.patch_area(patches_[i]) / total_area);
    }
    emitters_ = DiscreteDistribution(weights);
    sky_probability_ = sky_share(scene, total_power);
    choose_punctual_lights(total_power);
    emitter_probability_ = 1.0 - punctual_probability_ - sky_probability_;
    for (std::size_t i = 0; i < patches_.size(); ++i) {
        density_per_area_[patches_[i]] =
            emitter_probability_ * emitters_.probability(i) / scene.patch_area(patches_[i]);
    }
}

/// Takes their share of the samples from the others'. emitted: power of all emitters, own space.
void LightSampling::choose_punctual_lights(double emitted) {
    std::vector<double> fluxes;
    double total = 0.0;
    for (const PunctualLight& light : scene_.scene().punctual_lights) {
        punctual_.push_back(place_light(scene_.scene(), light));
        fluxes.push_back(flux_of(scene_, punctual_.back()));
        total += fluxes.back();
    }
    if (!(total > 0.0)) {  // none, or all are switched off
        punctual_.clear();
        return;
    }
    for (double& flux : fluxes) {
        flux = (1.0 - defensive_share) * flux / total +
               defensive_share / static_cast<double>(punctual_.size());
    }
    choice_ = DiscreteDistribution(fluxes);
    const bool alone = emitters_.empty() && !(sky_probability_ > 0.0);
    punctual_probability_ =
        alone ? 1.0 : std::clamp(total / (total + emitted), least_share, 1.0 - least_share);
    sky_probability_ *= 1.0 - punctual_probability_;
}

/// What a punctual light brings where nothing is in its way; at: where on its opening, or on the
/// disc of a directional one.
LightSampling::Arrival LightSampling::arrival(const SurfacePoint& from, const PlacedLight& light,
                                              const glm::dvec2& at) const {
    if (light.kind == PunctualKind::directional) {
        return {in_disc(-light.direction(), light.angular_radius, at), light.intensity};
    }
    const glm::dvec3 offset = scene_.from_world(light.point(at)) - from.position;
    const double square = glm::dot(offset, offset);
    if (!(square > 0.0)) {
        return {};
    }
    const glm::dvec3 direction = offset / std::sqrt(square);
    return {direction, light.towards(-direction) / (square * scene_.square_metres())};
}

/// By the illuminance that each would bring. A share by flux keeps every probability above 0, for
/// rounding and for what a cosine does not say.
LightSampling::ChosenLight LightSampling::choose_punctual(const SurfacePoint& from,
                                                          const Frame& receiver, double choice,
                                                          const glm::dvec2& at) const {
    const std::size_t count = punctual_.size();
    std::array<double, most_compared> brought{};
    double total = 0.0;
    if (count > 1 && count <= most_compared) {
        for (std::size_t i = 0; i < count; ++i) {
            const Arrival light = arrival(from, punctual_[i], at);
            brought[i] = std::max(glm::dot(light.direction, receiver.z), 0.0) *
                         luminance(glm::vec3(light.illuminance));
            total += brought[i];
        }
    }
    if (!(total > 0.0)) {
        const std::size_t index = choice_.sample(choice);
        return {index, choice_.probability(index)};
    }
    const auto share = [&](std::size_t i) {
        return (1.0 - defensive_share) * brought[i] / total +
               defensive_share * choice_.probability(i);
    };
    std::size_t index = 0;
    for (double rest = choice; index + 1 < count && rest >= share(index); ++index) {
        rest -= share(index);
    }
    return {index, share(index)};
}

std::optional<LightSample> LightSampling::sample_punctual(const SurfacePoint& from,
                                                          const Frame& receiver, double choice,
                                                          const glm::dvec2& at) const {
    const ChosenLight chosen = choose_punctual(from, receiver, choice, at);
    const PlacedLight& light = punctual_[chosen.index];
    const Arrival arriving = arrival(from, light, at);
    if (arriving.direction == glm::dvec3(0.0)) {
        return std::nullopt;
    }
    LightSample result;
    result.punctual = static_cast<int>(chosen.index);
    result.density = punctual_probability_ * chosen.probability;
    result.direction = arriving.direction;
    result.radiance = arriving.illuminance;
    if (light.kind != PunctualKind::directional) {
        result.origin = scene_.from_world(light.point(at));
    }
    return result;
}

EmittedParticle LightSampling::emit_punctual(double choice, const glm::dvec2& at,
                                             const glm::dvec2& direction) const {
    const std::size_t index = choice_.sample(choice);
    const PlacedLight& light = punctual_[index];
    EmittedParticle particle;
    particle.punctual = static_cast<int>(index);
    const double probability = punctual_probability(particle.punctual);
    if (light.kind == PunctualKind::directional) {
        particle.distant = true;
        particle.direction = in_disc(light.direction(), light.angular_radius, direction);
        particle.origin = on_disc(particle.direction, at);
        particle.power = light.intensity / (probability * sky_disc_density());
        return particle;
    }
    const double solid_angle = solid_angle_of(light);
    const double z = 1.0 - direction.y * solid_angle / (2.0 * pi);
    const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
    const double angle = 2.0 * pi * direction.x;
    particle.direction =
        Frame(light.direction()).to_world({r * std::cos(angle), r * std::sin(angle), z});
    particle.origin = scene_.from_world(light.point(at));
    particle.power =
        light.towards(particle.direction) * (solid_angle / (probability * scene_.square_metres()));
    return particle;
}

double LightSampling::punctual_direction_density(int light) const {
    return 1.0 / solid_angle_of(punctual_[static_cast<std::size_t>(light)]);
}

/// Point, evenly distributed, of a disc as large as the scene's bounding sphere, in front of it for
/// light of that direction.
glm::dvec3 LightSampling::on_disc(const glm::dvec3& direction, const glm::dvec2& at) const {
    const double radius = 0.5 * scene_.diameter();
    const double from_axis = radius * std::sqrt(at.y);
    return Frame(direction).to_world(
        {from_axis * std::cos(2.0 * pi * at.x), from_axis * std::sin(2.0 * pi * at.x), -radius});
}

EmittedParticle LightSampling::emit(double choice, const glm::dvec2& at,
                                    const glm::dvec2& direction) const {
    if (choice < punctual_probability_) {
        return emit_punctual(choice / punctual_probability_, at, direction);
    }
    const double others = choice - punctual_probability_;
    if (emitters_.empty() || others < sky_probability_) {
        return emit_from_sky(at, direction);
    }
    const double rest = (others - sky_probability_) / emitter_probability_;
    const std::uint32_t patch = patches_[emitters_.sample(rest)];
    EmittedParticle particle;
    particle.emitter = scene_.point_on_patch(patch, uniform_triangle(at));
    particle.direction = Frame(particle.emitter->normal).to_world(cosine_hemisphere(direction));
    particle.power = pi / density_per_area_[patch] * scene_.emission(*particle.emitter);
    return particle;
}

/// Lines of uniform direction through a disc as large as the scene's bounding sphere, across them.
EmittedParticle LightSampling::emit_from_sky(const glm::dvec2& at,
                                             const glm::dvec2& direction) const {
    const double radius = 0.5 * scene_.diameter();
    const double z = 1.0 - 2.0 * direction.y;
    const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
    const double angle = 2.0 * pi * direction.x;
    EmittedParticle particle;
    particle.distant = true;
    particle.direction = {r * std::cos(angle), r * std::sin(angle), z};
    particle.origin = on_disc(particle.direction, at);
    particle.power = 4.0 * pi * pi * radius * radius / sky_probability_ *
                     sky_towards(scene_.scene(), -particle.direction);
    return particle;
}

double LightSampling::sky_direction_density() const {
    return sky_probability_ / (4.0 * pi);
}

double LightSampling::sky_disc_density() const {
    const double radius = 0.5 * scene_.diameter();
    return 1.0 / (pi * radius * radius);
}

std::optional<LightSample> LightSampling::sample(const SurfacePoint& from, const Frame& receiver,
                                                 double choice, const glm::dvec2& at) const {
    if (choice < punctual_probability_) {
        return sample_punctual(from, receiver, choice / punctual_probability_, at);
    }
    const double others = choice - punctual_probability_;
    if (others >= sky_probability_) {
        std::optional<LightSample> light =
            sample_emitter(from, (others - sky_probability_) / emitter_probability_, at);
        if (light) {
            light->density *= emitter_probability_;
        }
        return light;
    }
    LightSample light;
    const double way = others / sky_probability_;  // which of the two ways to draw it
    light.direction = sky_.uniform() || way < 0.5 ? receiver.to_world(cosine_hemisphere(at))
                                                  : sky_.sample(2.0 * way - 1.0, at);
    light.radiance = sky_towards(scene_.scene(), light.direction);
    light.density = sky_density(receiver, light.direction);
    if (!(glm::dot(light.direction, from.normal) > 0.0)) {
        return std::nullopt;
    }
    return light;
}

/// Density, 1/sr, with which sample() draws a direction of the sky.
double LightSampling::sky_density(const Frame& receiver, const glm::dvec3& direction) const {
    const double by_cosine = std::max(glm::dot(direction, receiver.z), 0.0) / pi;
    return sky_probability_ *
           (sky_.uniform() ? by_cosine : 0.5 * (by_cosine + sky_.density(direction)));
}

std::optional<LightSample> LightSampling::sample_emitter(const SurfacePoint& from, double choice,
                                                         const glm::dvec2& at) const {
    if (emitters_.empty()) {
        return std::nullopt;
    }
    const std::uint32_t patch = patches_[emitters_.sample(choice)];
    LightSample light;
    light.emitter = scene_.point_on_patch(patch, uniform_triangle(at));
    const glm::dvec3 offset = light.emitter->position - from.position;
    const double square = glm::dot(offset, offset);
    if (!(square > 0.0)) {
        return std::nullopt;
    }
    light.direction = offset / std::sqrt(square);
    const double cosine = -glm::dot(light.direction, light.emitter->normal);
    if (!(cosine > 0.0)) {
        return std::nullopt;
    }
    light.radiance = scene_.emission(*light.emitter);
    light.density = density_per_area_[patch] * square / (cosine * emitter_probability_);
    return light;
}

double LightSampling::emitter_density(const SurfacePoint& from, const glm::dvec3& direction,
                                      const SurfacePoint& emitter) const {
    if (emitter.absorbs() || density_per_area_[emitter.patch] <= 0.0) {
        return 0.0;
    }
    const glm::dvec3 offset = emitter.position - from.position;
    const double cosine = -glm::dot(direction, emitter.normal);
    return cosine > 0.0 ? density_per_area_[emitter.patch] * glm::dot(offset, offset) /
                              (cosine * emitter_probability_)
                        : 0.0;
}

bool LightSampling::arrives(const SurfacePoint& from, const LightSample& light) const {
    if (light.origin) {
        return scene_.sees_point(from, *light.origin);
    }
    return light.emitter ? scene_.mutually_visible(from, *light.emitter)
                         : scene_.sees_sky(from, light.direction);
}

glm::dvec3 LightSampling::arriving_share(const SurfacePoint& from, const LightSample& light) const {
    if (light.punctual == LightSample::no_light) {
        return glm::dvec3(arrives(from, light) ? 1.0 : 0.0);
    }
    const glm::dvec3 start(scene_.departure(from));
    return light.origin ? share_through_panes(scene_, start, *light.origin)
                        : share_through_panes_from_sky(scene_, start, light.direction);
}

double LightSampling::density(const SurfacePoint& from, const Frame& receiver,
                              const glm::dvec3& direction,
                              const std::optional<SurfacePoint>& hit) const {
    return hit ? emitter_probability_ * emitter_density(from, direction, *hit)
               : sky_density(receiver, direction);
}

}  // namespace raybundle
