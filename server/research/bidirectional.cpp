// SPDX-License-Identifier: Apache-2.0
// Paths are numbered from the light: x[0] lies on it, x[k] is the eye. A path of k + 1 vertices is
// made of `light_count` vertices of a light subpath and the rest of an eye subpath, in reverse.
#include "research/bidirectional.h"

#include <algorithm>
#include <cmath>

#include "scene/light/environment.h"

namespace raybundle {
namespace {

using Kind = PathVertex::Kind;

bool is_black(const glm::dvec3& value) {
    return value == glm::dvec3(0.0);
}

}  // namespace

glm::dvec3 Bidirectional::radiance(const glm::dvec3& direction, PixelSampler& sampler,
                                   std::vector<Splat>& splats) const {
    const Subpath eye = subpaths_.from_eye(direction, sampler);
    const Subpath light = subpaths_.from_light(sampler);
    glm::dvec3 sum(0.0);
    for (std::size_t t = 2; t <= eye.size(); ++t) {
        sum += met_light(eye, t);
        if (!eye[t - 1].lobe) {
            continue;
        }
        sum += next_event(eye, t, sampler);
        for (std::size_t s = 2; s <= light.size(); ++s) {
            if (light[s - 1].lobe) {
                sum += joined(light, s, eye, t);
            }
        }
    }
    for (std::size_t s = 2; s <= light.size(); ++s) {
        if (light[s - 1].lobe) {
            join_with_eye(light, s, splats);
        }
    }
    return sum;
}

/// The densities that the subpaths know; those next to where they are joined are left at 0.
Bidirectional::Densities Bidirectional::known(const Subpath& light, std::size_t light_count,
                                              const Subpath& eye, std::size_t eye_count) const {
    const std::size_t count = light_count + eye_count;
    Densities d{std::vector<double>(count), std::vector<double>(count), std::vector<bool>(count)};
    for (std::size_t i = 0; i < light_count; ++i) {
        d.deflects[i] = light[i].deflects;
        d.light[i] = light[i].forward;
        d.eye[i] = i + 2 < light_count ? light[i].backward : 0.0;
    }
    for (std::size_t i = light_count; i < count; ++i) {
        const PathVertex& vertex = eye[count - 1 - i];
        d.deflects[i] = vertex.deflects;
        d.eye[i] = vertex.forward;
        d.light[i] = i >= light_count + 2 ? vertex.backward : 0.0;
    }
    return d;
}

/// Balance heuristic. The path has density light[0..s) eye[s..) when s vertices are the light
/// path's; the s that made it is light_count. Emitters that the eye sees have one way only.
double Bidirectional::weight(const Densities& d, std::size_t light_count) {
    const std::size_t edges = d.light.size() - 1;
    if (edges == 1) {
        return 1.0;
    }
    const auto share = [&](std::size_t s) {
        if (s > 0 && (d.deflects[s - 1] || d.deflects[s])) {
            return 0.0;  // they cannot be joined
        }
        return s == 1 ? d.connect : 1.0;
    };
    double sum = share(light_count);
    double ratio = 1.0;
    for (std::size_t i = light_count; i < edges; ++i) {
        ratio *= d.light[i] / d.eye[i];
        sum += ratio * share(i + 1);
    }
    ratio = 1.0;
    for (std::size_t i = light_count; i > 0; --i) {
        ratio *= d.eye[i - 1] / d.light[i - 1];
        sum += ratio * share(i - 1);
    }
    return share(light_count) / sum;
}

/// The sky is drawn by its cosine at the receiver in next-event estimation, evenly for light paths.
double Bidirectional::connect_ratio(const PathVertex& light, const PathVertex& lit,
                                    const glm::dvec3& to_light) const {
    return light.kind == Kind::sky && lit.lobe
               ? lights_.density(lit.point, lit.lobe->frame(), to_light, std::nullopt) /
                     lights_.sky_direction_density()
               : 1.0;
}

/// s = 0: the eye path has met an emitter or the sky.
glm::dvec3 Bidirectional::met_light(const Subpath& eye, std::size_t eye_count) const {
    const PathVertex& end = eye[eye_count - 1];
    const bool sky = end.kind == Kind::sky;
    const bool seen = std::all_of(eye.begin() + 1, eye.begin() + static_cast<long>(eye_count) - 1,
                                  [](const PathVertex& vertex) { return vertex.deflects; });
    const glm::dvec3 emitted =
        !sky   ? (seen ? scene_.shown_emission(end.point) : scene_.emission(end.point))
        : seen ? background_towards(scene_.scene(), -end.towards)
               : sky_towards(scene_.scene(), -end.towards);
    if (is_black(emitted)) {
        return emitted;
    }
    Densities d = known({}, 0, eye, eye_count);
    if (eye_count > 2) {
        const PathVertex& lit = eye[eye_count - 2];
        d.light[0] = sky ? lights_.sky_direction_density() : lights_.area_density(end.point.patch);
        d.light[1] = subpaths_.emission_density(end, lit.point, end.towards);
        d.connect = connect_ratio(end, lit, -end.towards);
    }
    return end.throughput * emitted * weight(d, 0);
}

/// s = 1: a light chosen for the eye path's last vertex.
glm::dvec3 Bidirectional::next_event(const Subpath& eye, std::size_t eye_count,
                                     PixelSampler& sampler) const {
    if (lights_.empty()) {
        return glm::dvec3(0.0);
    }
    const PathVertex& lit = eye[eye_count - 1];
    const double choice = sampler.next();
    const std::optional<LightSample> light =
        lights_.sample(lit.point, lit.lobe->frame(), choice, sampler.next_pair());
    if (!light) {
        return glm::dvec3(0.0);
    }
    const glm::dvec3 value =
        lit.throughput * lit.lobe->evaluate(light->direction) * light->radiance / light->density;
    if (is_black(value) || !lights_.arrives(lit.point, *light)) {
        return glm::dvec3(0.0);
    }
    // Of punctual lights the weights know the probability that light paths choose them with:
    // weights of one path add up to 1 all the same.
    const PathVertex end = subpaths_.light_vertex(light->punctual, light->emitter, light->origin);
    Densities d = known({end}, 1, eye, eye_count);
    d.eye[0] = vertex_density(end, lit.lobe->density(light->direction), lit.point.position);
    d.light[1] = subpaths_.emission_density(end, lit.point, -light->direction);
    if (eye_count > 2) {
        d.light[2] = per_area(lit.lobe->reverse_density(light->direction), lit.point.position,
                              eye[eye_count - 2].point);
    }
    d.connect = connect_ratio(end, lit, light->direction);
    return value * weight(d, 1);
}

/// The last vertices of both subpaths, if they see each other.
glm::dvec3 Bidirectional::joined(const Subpath& light, std::size_t light_count, const Subpath& eye,
                                 std::size_t eye_count) const {
    const PathVertex& y = light[light_count - 1];
    const PathVertex& z = eye[eye_count - 1];
    const glm::dvec3 offset = z.point.position - y.point.position;
    const double square = glm::dot(offset, offset);
    if (!(square > 0.0)) {
        return glm::dvec3(0.0);
    }
    const glm::dvec3 direction = offset / std::sqrt(square);
    const glm::dvec3 value = y.throughput * y.lobe->evaluate(direction) * z.throughput *
                             z.lobe->evaluate(-direction) / square;
    if (is_black(value) || !scene_.mutually_visible(y.point, z.point)) {
        return glm::dvec3(0.0);
    }
    const std::size_t s = light_count;
    Densities d = known(light, s, eye, eye_count);
    d.light[s] = per_area(y.lobe->density(direction), y.point.position, z.point);
    d.eye[s - 1] = per_area(z.lobe->density(-direction), z.point.position, y.point);
    d.eye[s - 2] =
        vertex_density(light[s - 2], y.lobe->reverse_density(direction), y.point.position);
    if (eye_count > 2) {
        d.light[s + 1] = per_area(z.lobe->reverse_density(-direction), z.point.position,
                                  eye[eye_count - 2].point);
    }
    d.connect = connect_ratio(light[0], light[1], light[1].towards);
    return value * weight(d, s);
}

/// t = 1: the eye sees the light path's last vertex.
void Bidirectional::join_with_eye(const Subpath& light, std::size_t light_count,
                                  std::vector<Splat>& splats) const {
    const PathVertex& y = light[light_count - 1];
    const glm::dvec3 offset = camera_.origin() - y.point.position;
    const double square = glm::dot(offset, offset);
    const glm::dvec3 to_eye = offset / std::sqrt(square);
    const std::optional<FilmPoint> film = camera_.project(-to_eye);
    if (!film || !(glm::dot(to_eye, y.point.normal) > 0.0)) {
        return;
    }
    const Scattering seen(scene_, y.point, NormalKind::shading, to_eye);
    // The light path's flux is per cosine of the geometric normal.
    const double arriving = glm::dot(y.towards, y.point.normal);
    const glm::dvec3 value = y.throughput * seen.evaluate(y.towards) / arriving *
                             (glm::dot(to_eye, y.point.normal) / square) * film->importance;
    if (is_black(value) || !scene_.sees_point(y.point, camera_.origin())) {
        return;
    }
    const std::size_t s = light_count;
    Subpath eye(1);
    eye[0].forward = 1.0;
    Densities d = known(light, s, eye, 1);
    d.eye[s - 1] = per_area(camera_.density(-to_eye), camera_.origin(), y.point);
    d.eye[s - 2] = vertex_density(light[s - 2], seen.density(y.towards), y.point.position);
    PathVertex lit = light[1];
    if (s == 2) {
        lit.lobe = seen;
    }
    d.connect = connect_ratio(light[0], lit, light[1].towards);
    splats.push_back({film->pixel, value * weight(d, s) * camera_.pixel_share()});
}

}  // namespace raybundle
