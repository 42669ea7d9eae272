// SPDX-License-Identifier: Apache-2.0
#include "research/path_vertices.h"

#include <algorithm>
#include <cmath>

#include "reference/sampling/roulette.h"

namespace raybundle {
namespace {

constexpr std::size_t max_vertices = 1U << 12U;  // far beyond what Russian roulette lets live
constexpr std::size_t certain_vertices = 4;      // before Russian roulette begins

}  // namespace

double vertex_density(const PathVertex& vertex, double density, const glm::dvec3& from) {
    switch (vertex.kind) {
        case PathVertex::Kind::sky:
            return density;
        case PathVertex::Kind::point_light:
        case PathVertex::Kind::directional_light:
            return 0.0;
        default:
            return per_area(density, from, vertex.point);
    }
}

double per_area(double density, const glm::dvec3& from, const SurfacePoint& to) {
    const glm::dvec3 offset = to.position - from;
    const double square = glm::dot(offset, offset);
    return square > 0.0
               ? density * std::abs(glm::dot(offset, to.normal)) / (square * std::sqrt(square))
               : 0.0;
}

Subpath SubpathSampler::from_eye(const glm::dvec3& direction, PixelSampler& sampler) const {
    Subpath path(1);
    path[0].kind = PathVertex::Kind::eye;
    path[0].point.position = camera_.origin();
    path[0].forward = 1.0;
    const std::optional<SurfacePoint> hit = scene_.trace(camera_.origin(), direction);
    PathVertex vertex;
    vertex.towards = -direction;
    if (!hit) {
        vertex.kind = PathVertex::Kind::sky;
        vertex.forward = camera_.density(direction);
        path.push_back(vertex);
        return path;
    }
    vertex.point = *hit;
    vertex.forward = per_area(camera_.density(direction), camera_.origin(), *hit);
    find_reflection(vertex, NormalKind::shading);
    path.push_back(vertex);
    extend(path, direction, Carried::radiance, sampler);
    return path;
}

Subpath SubpathSampler::from_light(PixelSampler& sampler) const {
    Subpath path(1);
    if (lights_.empty()) {
        return path;
    }
    const double choice = sampler.next();
    const glm::dvec2 at = sampler.next_pair();
    const EmittedParticle particle = lights_.emit(choice, at, sampler.next_pair());
    std::optional<glm::dvec3> origin;
    if (!particle.distant) {
        origin = particle.origin;
    }
    PathVertex& light = path[0];
    light = light_vertex(particle.punctual, particle.emitter, origin);
    light.towards = particle.direction;
    if (particle.power == glm::dvec3(0.0)) {
        return path;
    }
    const std::optional<SurfacePoint> hit = first_hit(scene_, particle);
    if (!hit) {
        return path;
    }
    PathVertex vertex;
    vertex.point = *hit;
    vertex.towards = -particle.direction;
    vertex.throughput = particle.power;
    vertex.forward = emission_density(light, *hit, particle.direction);
    find_reflection(vertex, NormalKind::geometric);
    if (!vertex.goes_on()) {
        return path;
    }
    path.push_back(vertex);
    extend(path, particle.direction, Carried::power, sampler);
    return path;
}

PathVertex SubpathSampler::light_vertex(int punctual, const std::optional<SurfacePoint>& emitter,
                                        const std::optional<glm::dvec3>& origin) const {
    PathVertex vertex;
    if (punctual != LightSample::no_light) {
        vertex.kind = origin ? PathVertex::Kind::point_light : PathVertex::Kind::directional_light;
        vertex.point.position = origin.value_or(glm::dvec3(0.0));
        vertex.punctual = punctual;
        vertex.forward = lights_.punctual_probability(punctual);
        return vertex;
    }
    vertex.kind = emitter ? PathVertex::Kind::emitter : PathVertex::Kind::sky;
    vertex.point = emitter.value_or(SurfacePoint{});
    vertex.forward =
        emitter ? lights_.area_density(emitter->patch) : lights_.sky_direction_density();
    return vertex;
}

double SubpathSampler::emission_density(const PathVertex& light, const SurfacePoint& lit,
                                        const glm::dvec3& direction) const {
    if (light.kind == PathVertex::Kind::point_light) {
        return per_area(lights_.punctual_direction_density(light.punctual), light.point.position,
                        lit);
    }
    if (light.kind == PathVertex::Kind::sky || light.kind == PathVertex::Kind::directional_light) {
        return lights_.sky_disc_density() * std::abs(glm::dot(direction, lit.normal));
    }
    const double cosine = std::max(glm::dot(direction, light.point.normal), 0.0);
    return per_area(cosine * glm::one_over_pi<double>(), light.point.position, lit);
}

/// What the surface at a vertex does with light that comes from `towards` or goes there.
void SubpathSampler::find_reflection(PathVertex& vertex, NormalKind normal) const {
    vertex.deflects = is_deflecting(scene_, vertex.point);
    if (!vertex.deflects && !vertex.point.absorbs()) {
        vertex.lobe.emplace(scene_, vertex.point, normal, vertex.towards);
    }
}

/// How a subpath goes on from a vertex.
struct SubpathSampler::Onward {
    SurfacePoint departure;
    glm::dvec3 direction;
    glm::dvec3 weight;  // of the throughput
    double density;     // of the direction, per solid angle
    double backward;    // that of the direction it came from, in reverse
};

std::optional<SubpathSampler::Onward> SubpathSampler::onward(const PathVertex& vertex,
                                                             const glm::dvec3& direction,
                                                             Carried carried,
                                                             PixelSampler& sampler) const {
    if (vertex.deflects) {
        const auto ray = deflect(scene_, vertex.point, direction, carried, sampler);
        return ray ? std::optional<Onward>({ray->departure, ray->direction, ray->weight,
                                            ray->chance, ray->chance * ray->solid_angle_ratio})
                   : std::nullopt;
    }
    const glm::dvec2 u = sampler.next_pair();
    const std::optional<ScatterSample> next = vertex.lobe->sample(u, sampler.next());
    return next ? std::optional<Onward>({vertex.point, next->direction, next->weight, next->density,
                                         vertex.lobe->reverse_density(next->direction)})
                : std::nullopt;
}

/// Continues a subpath whose last vertex has just been found. Those of radiance end with a vertex
/// where they meet nothing, or a surface that absorbs; those of power have none there.
void SubpathSampler::extend(Subpath& path, glm::dvec3 direction, Carried carried,
                            PixelSampler& sampler) const {
    const glm::dvec3 start = path.back().throughput;
    bool seen_by_eye = carried == Carried::radiance;
    while (path.size() < max_vertices && path.back().goes_on()) {
        const PathVertex& last = path.back();
        seen_by_eye = seen_by_eye && last.deflects;
        const std::optional<Onward> next = onward(last, direction, carried, sampler);
        if (!next) {
            return;
        }
        PathVertex vertex;
        vertex.throughput = last.throughput * next->weight;
        if (path.size() >= certain_vertices &&
            !survives(vertex.throughput, start, sampler.next())) {
            return;
        }
        direction = next->direction;
        vertex.towards = -direction;
        const std::optional<SurfacePoint> hit = scene_.trace_from(next->departure, direction);
        vertex.kind = hit ? PathVertex::Kind::surface : PathVertex::Kind::sky;
        vertex.point = hit.value_or(SurfacePoint{});
        vertex.forward = vertex_density(vertex, next->density, last.point.position);
        if (hit) {
            find_reflection(vertex, seen_by_eye ? NormalKind::shading : NormalKind::geometric);
        }
        if (hit && last.deflects) {
            vertex.throughput *= left_of_way(scene_, last.point.position, *hit);
        }
        if (carried == Carried::power && !vertex.goes_on()) {
            return;
        }
        PathVertex& before = path[path.size() - 2];
        before.backward = vertex_density(before, next->backward, last.point.position);
        path.push_back(vertex);
    }
}

}  // namespace raybundle
