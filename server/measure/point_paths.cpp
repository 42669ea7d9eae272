// SPDX-License-Identifier: Apache-2.0
#include "measure/point_paths.h"

#include <cmath>
#include <numbers>

#include "reference/sampling/pane_shares.h"
#include "reference/specular_walk.h"
#include "scene/light/environment.h"

namespace raybundle {
namespace {

using std::numbers::pi;

/// Points of emitters for each path: a shadow ray costs a tenth of a path.
constexpr int emitter_samples = 4;

PathSettings path_settings() {
    PathSettings settings;
    settings.panes = Panes::pass;
    return settings;
}

double luminance_of(const glm::dvec3& colour) {
    return static_cast<double>(luminance(glm::vec3(colour)));
}

bool has_disc(const PlacedLight& light) {
    return light.kind == PunctualKind::directional && light.angular_radius > 0.0;
}

/// A direction within a disc about another, evenly as a surface across it receives light.
glm::dvec3 in_disc(const glm::dvec3& centre, double radius, const glm::dvec2& at) {
    const double from_axis = std::sin(radius) * std::sqrt(at.y);
    return Frame(centre).to_world({from_axis * std::cos(2.0 * pi * at.x),
                                   from_axis * std::sin(2.0 * pi * at.x),
                                   std::sqrt(1.0 - from_axis * from_axis)});
}

}  // namespace

MeasuredScene::MeasuredScene(const Scene& scene, const PatchMesh& mesh)
    : rays(scene, mesh), lights(rays), paths(rays, lights, path_settings()) {
    for (const PunctualLight& light : scene.punctual_lights) {
        const PlacedLight placed = place_light(scene, light);
        if (placed.intensity != glm::dvec3(0.0)) {
            punctual.push_back(placed);
        }
    }
}

/// Share of light that the air leaves between two points.
double PointPaths::left_between(const glm::dvec3& a, const glm::dvec3& b) const {
    return scene_.paths.air() ? scene_.paths.air()->transmittance_between(a, b) : 1.0;
}

double PointPaths::left_from_sky(const glm::dvec3& at, const glm::dvec3& direction) const {
    return scene_.paths.air() ? scene_.paths.air()->transmittance_to_sky(at, direction) : 1.0;
}

double PointPaths::fixed(const glm::dvec3& position, const Receiver& receiver) const {
    double sum = 0.0;
    for (const PlacedLight& light : scene_.punctual) {
        if (has_disc(light)) {
            continue;
        }
        if (light.kind == PunctualKind::directional) {
            const glm::dvec3 direction = -light.direction();
            const double weight = receiver.weight(direction) * left_from_sky(position, direction);
            sum +=
                weight > 0.0
                    ? weight * luminance_of(light.intensity * share_through_panes_from_sky(
                                                                  scene_.rays, position, direction))
                    : 0.0;
            continue;
        }
        sum += light.has_opening() ? by_opening(light, position, receiver)
                                   : by_point(light, light.position, position, receiver);
    }
    return sum;
}

/// What a light brings that shines from one place, of the world, alone.
double PointPaths::by_point(const PlacedLight& light, const glm::dvec3& place,
                            const glm::dvec3& position, const Receiver& receiver) const {
    const glm::dvec3 there = scene_.rays.from_world(place);
    const glm::dvec3 offset = there - position;
    const double square = glm::dot(offset, offset);
    if (!(square > 0.0)) {
        return 0.0;
    }
    const glm::dvec3 direction = offset / std::sqrt(square);
    const double brought = receiver.weight(direction) * left_between(position, there) /
                           (square * scene_.rays.square_metres());
    const glm::dvec3 intensity = light.towards(-direction);
    if (!(brought > 0.0) || intensity == glm::dvec3(0.0)) {
        return 0.0;
    }
    return brought * luminance_of(intensity * share_through_panes(scene_.rays, position, there));
}

/// The mean over the opening. Where a part of it brings nothing, by a Fibonacci lattice, which no
/// edge of a shadow lies along.
double PointPaths::by_opening(const PlacedLight& light, const glm::dvec3& position,
                              const Receiver& receiver) const {
    constexpr double tolerance = 1e-4;  // of the file's flux, too: IesProfile
    const double distance = glm::distance(scene_.rays.from_world(light.position), position) *
                            std::sqrt(scene_.rays.square_metres());
    bool any = false;
    bool all = true;
    double sum = 0.0;
    for (const OpeningPoint& point : opening_points(light.opening, distance, tolerance)) {
        const double brought = by_point(light, light.point(point.u), position, receiver);
        any = any || brought > 0.0;
        all = all && brought > 0.0;
        sum += point.weight * brought;
    }
    if (all || !any) {
        return sum;
    }
    constexpr int count = 1597;  // Fibonacci's 17th number, and the one before
    constexpr int step = 987;
    sum = 0.0;
    for (int i = 0; i < count; ++i) {
        const glm::dvec2 at = (glm::dvec2(i, (i * step) % count) + 0.5) / double{count};
        sum += by_point(light, light.point(at), position, receiver);
    }
    return sum / count;
}

ArrivedLight PointPaths::sample(const glm::dvec3& position, const Receiver& receiver,
                                bool reflected, Sampler& sampler) const {
    SurfacePoint at;
    at.position = position;
    const double sampled = discs(position, receiver, sampler) + emitters(at, receiver, sampler);
    ArrivedLight light = along_path(at, receiver, reflected, sampler);
    light.direct += sampled;
    return light;
}

double PointPaths::discs(const glm::dvec3& position, const Receiver& receiver,
                         Sampler& sampler) const {
    double sum = 0.0;
    for (const PlacedLight& light : scene_.punctual) {
        if (!has_disc(light)) {
            continue;
        }
        const glm::dvec3 direction =
            in_disc(-light.direction(), light.angular_radius, sampler.next_pair());
        const double weight = receiver.weight(direction) * left_from_sky(position, direction);
        if (weight > 0.0) {
            sum += weight * luminance_of(light.intensity * share_through_panes_from_sky(
                                                               scene_.rays, position, direction));
        }
    }
    return sum;
}

double PointPaths::emitters(const SurfacePoint& at, const Receiver& receiver,
                            Sampler& sampler) const {
    if (!scene_.lights.has_emitters()) {
        return 0.0;
    }
    double sum = 0.0;
    const double choice = sampler.next();
    for (int i = 0; i < emitter_samples; ++i) {
        const auto light =
            scene_.lights.sample_emitter(at, (i + choice) / emitter_samples, sampler.next_pair());
        const double weight = light ? receiver.weight(light->direction) : 0.0;
        if (!(weight > 0.0) || !scene_.rays.unobstructed(glm::vec3(at.position),
                                                         scene_.rays.departure(*light->emitter))) {
            continue;
        }
        const double all = emitter_samples * light->density;
        sum += weight * luminance_of(light->radiance) * power_heuristic(all, weight / pi) / all *
               left_between(at.position, light->emitter->position);
    }
    return sum;
}

ArrivedLight PointPaths::along_path(const SurfacePoint& at, const Receiver& receiver,
                                    bool reflected, Sampler& sampler) const {
    const glm::dvec3 direction = receiver.sample(sampler);
    const SpecularWalk met = walk_specular(scene_.rays, scene_.rays.trace(at.position, direction),
                                           direction, Carried::radiance, sampler);
    ArrivedLight light;
    const glm::dvec3 emission =
        met.hit ? scene_.rays.emission(*met.hit) : sky_towards(scene_.rays.scene(), met.direction);
    if (emission != glm::dvec3(0.0)) {
        const double other =
            met.hit && !met.passed ? scene_.lights.emitter_density(at, direction, *met.hit) : 0.0;
        const double left = met.hit ? left_between(at.position, met.hit->position)
                                    : left_from_sky(at.position, met.direction);
        light.direct = left * pi * luminance_of(met.weight * emission) *
                       power_heuristic(receiver.weight(direction) / pi, emitter_samples * other);
    }
    if (reflected && scene_.paths.air()) {
        light.reflected = pi * luminance_of(scene_.paths.indirect(at.position, direction, sampler));
    } else if (reflected) {
        if (const auto end = scene_.paths.end_of(met, sampler)) {
            light.reflected = pi * luminance_of(scene_.paths.reflected(*end, sampler));
        }
    }
    return light;
}

}  // namespace raybundle
