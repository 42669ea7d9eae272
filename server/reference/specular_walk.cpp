// SPDX-License-Identifier: Apache-2.0
#include "reference/specular_walk.h"

#include <cmath>

#include "scene/material/ggx_albedo.h"
#include "scene/material/specular_surface.h"
#include "scene/mesh/patch_colour.h"

namespace raybundle {
namespace {

constexpr int most_surfaces = 256;

/// Both ways that light takes at a surface of glass.
struct Ways {
    glm::dvec3 reflected{0.0}, passed{0.0};  // shares
    glm::dvec3 behind{0.0};                  // direction of what passes
};

Ways ways_at(const SpecularSurface& glass, bool front, const glm::dvec3& direction,
             const glm::dvec3& normal) {
    Ways ways;
    const auto cosine = static_cast<float>(-glm::dot(direction, normal));
    if (glass.kind == SpecularKind::pane) {
        const PaneShares shares = pane_shares(glass, cosine);
        ways.reflected = glm::dvec3(shares.reflected);
        ways.passed = glm::dvec3(shares.transmitted);
        ways.behind = direction;
        return ways;
    }
    const float index = front ? glass.ior : 1.0F / glass.ior;
    const auto behind = refracted(glm::vec3(direction), glm::vec3(normal), index);
    ways.reflected =
        glm::dvec3(behind ? static_cast<double>(fresnel_reflectance(cosine, index)) : 1.0);
    if (behind) {
        ways.passed = (1.0 - ways.reflected) * glm::dvec3(glass.tint);
        ways.behind = glm::normalize(glm::dvec3(*behind));
    }
    return ways;
}

double mean_of(const glm::dvec3& c) {
    return (c.r + c.g + c.b) / 3.0;
}

/// Whether a point's material is followed here, and as what; kind none where it is not.
SpecularSurface specular_at(const RayScene& scene, const SurfacePoint& point) {
    const Material& material = scene.material(point);
    if (is_glass(material)) {
        return specular_surface(material, mean_base_colour(scene.scene(), material));
    }
    const bool ideal = !point.absorbs() && specular_kind(material) == SpecularKind::mirror &&
                       material.roughness < min_roughness && material.clear_coat == 0.0F &&
                       scene.scene().punctual_lights.empty();
    return ideal ? specular_surface(material, scene.base_colour(point)) : SpecularSurface{};
}

/// What a point's material is for a viewer's rays, which take nearly ideal mirrors for ideal ones.
SpecularSurface seen_specular_at(const RayScene& scene, const SurfacePoint& point) {
    const Material& material = scene.material(point);
    const bool mirror = !point.absorbs() && specular_kind(material) == SpecularKind::mirror;
    return mirror ? specular_surface(material, scene.base_colour(point))
                  : specular_at(scene, point);
}

/// Chooses the stronger of two ways.
class Stronger final : public Sampler {
  public:
    double next() override { return 0.5; }
    glm::dvec2 next_pair() override { return glm::dvec2(0.5); }
};

/// Into the mirrored direction about the smooth normal, or where that leads behind the surface
/// about the geometric one. Returns the normal that it took.
glm::dvec3 reflect_about(Deflection& ray, const glm::dvec3& direction, const glm::dvec3& normal) {
    const glm::dvec3& geometric = ray.departure.normal;
    const glm::dvec3 smooth = glm::reflect(direction, normal);
    const bool in_front = glm::dot(smooth, geometric) > 0.0;
    ray.direction = in_front ? smooth : glm::reflect(direction, geometric);
    return in_front ? normal : geometric;
}

/// Of the etendue of rays about the geometric normal, after over before. The direction turns about
/// `normal`, which keeps the etendue about that one, squared indices of refraction included.
double etendue_ratio(const glm::dvec3& before, const glm::dvec3& after, const glm::dvec3& normal,
                     const glm::dvec3& geometric_normal) {
    return std::abs(glm::dot(after, geometric_normal) * glm::dot(before, normal) /
                    (glm::dot(before, geometric_normal) * glm::dot(after, normal)));
}

/// Chooses one of both ways at glass; returns the normal about which the ray turns.
glm::dvec3 choose_way(Deflection& ray, const SpecularSurface& glass, bool front,
                      const glm::dvec3& direction, const glm::dvec3& normal, Sampler& sampler) {
    const Ways ways = ways_at(glass, front, direction, normal);
    const double reflected = mean_of(ways.reflected);
    const double both = reflected + mean_of(ways.passed);
    const double chance = both > 0.0 ? reflected / both : 1.0;
    if (sampler.next() < chance) {
        ray.chance = chance;
        ray.weight = ways.reflected / chance;
        return reflect_about(ray, direction, normal);
    }
    ray.chance = 1.0 - chance;
    ray.weight = ways.passed / ray.chance;
    ray.direction = ways.behind;
    if (glass.kind == SpecularKind::glass) {
        ray.index = front ? glass.ior : 1.0 / glass.ior;
        ray.solid_angle_ratio = std::abs(glm::dot(direction, normal) /
                                         (ray.index * ray.index * glm::dot(ways.behind, normal)));
    }
    return normal;
}

/// deflect() at a point that is such a surface.
std::optional<Deflection> deflect_at(const RayScene& scene, const SpecularSurface& surface,
                                     const SurfacePoint& point, const glm::dvec3& direction,
                                     Carried carried, Sampler& sampler) {
    if (surface.kind == SpecularKind::none) {
        return std::nullopt;
    }
    glm::dvec3 normal = scene.shading_normal(point);
    if (glm::dot(normal, direction) >= 0.0) {
        normal = point.normal;
    }
    Deflection ray;
    ray.departure = point;
    if (surface.kind == SpecularKind::mirror) {
        const auto cosine = static_cast<float>(-glm::dot(direction, normal));
        ray.weight = glm::dvec3(mirror_reflectance(surface, cosine));
        normal = reflect_about(ray, direction, normal);
    } else {
        const bool front = point.patch == point.triangle;
        normal = choose_way(ray, surface, front, direction, normal, sampler);
    }
    if (carried == Carried::power) {
        // As radiance is not scaled by the index of refraction, power inside of glass is.
        ray.weight *=
            etendue_ratio(direction, ray.direction, normal, point.normal) / (ray.index * ray.index);
    }
    if (glm::dot(ray.direction, point.normal) < 0.0) {
        ray.departure.normal = -point.normal;  // rays start behind the surface
    }
    return ray;
}

}  // namespace

bool is_deflecting(const RayScene& scene, const SurfacePoint& point) {
    return specular_at(scene, point).kind != SpecularKind::none;
}

std::optional<Deflection> deflect(const RayScene& scene, const SurfacePoint& point,
                                  const glm::dvec3& direction, Carried carried, Sampler& sampler) {
    return deflect_at(scene, specular_at(scene, point), point, direction, carried, sampler);
}

bool ends_inside_glass(const RayScene& scene, const SurfacePoint& to) {
    const Material& material = scene.material(to);
    return to.patch != to.triangle && specular_kind(material) == SpecularKind::glass;
}

glm::dvec3 left_of_way(const RayScene& scene, const glm::dvec3& from, const SurfacePoint& to) {
    const Material& material = scene.material(to);
    if (!is_glass(material) || to.patch == to.triangle) {
        return glm::dvec3(1.0);
    }
    const SpecularSurface inside =
        specular_surface(material, mean_base_colour(scene.scene(), material));
    if (inside.kind != SpecularKind::glass) {
        return glm::dvec3(1.0);
    }
    const double metres = glm::distance(from, to.position) * std::sqrt(scene.square_metres());
    return glm::exp(-glm::dvec3(inside.absorption) * metres);
}

namespace {

/// A ray from an eye has come to where it is from an origin: it ends at a luminaire on that way.
void see_luminaire(const RayScene& scene, const glm::dvec3& origin, SpecularWalk& walk) {
    if (const auto met = scene.luminaire_before(origin, walk.direction, walk.hit)) {
        walk.luminaire = met->luminance;
        walk.hit.reset();
    }
}

/// surface_at: what a point is for these rays. eye: origin of one that sees luminaires, else null.
SpecularWalk walk(const RayScene& scene, const std::optional<SurfacePoint>& hit,
                  const glm::dvec3& direction, Carried carried, Sampler& sampler,
                  SpecularSurface (*surface_at)(const RayScene&, const SurfacePoint&),
                  const glm::dvec3* eye = nullptr) {
    SpecularWalk walk{hit, direction};
    if (eye != nullptr) {
        see_luminaire(scene, *eye, walk);
    }
    for (int i = 0; walk.hit; ++i) {
        const std::optional<Deflection> ray = deflect_at(
            scene, surface_at(scene, *walk.hit), *walk.hit, walk.direction, carried, sampler);
        if (!ray) {
            break;
        }
        if (i == most_surfaces) {
            walk.weight = glm::dvec3(0.0);
            walk.hit.reset();
            break;
        }
        walk.passed = true;
        walk.direction = ray->direction;
        walk.weight *= ray->weight;
        walk.hit = scene.trace_from(ray->departure, ray->direction);
        if (eye != nullptr) {
            see_luminaire(scene, ray->departure.position, walk);
        }
        if (walk.hit) {
            walk.weight *= left_of_way(scene, ray->departure.position, *walk.hit);
        }
    }
    return walk;
}

}  // namespace

SpecularWalk walk_specular(const RayScene& scene, const std::optional<SurfacePoint>& hit,
                           const glm::dvec3& direction, Carried carried, Sampler& sampler) {
    return walk(scene, hit, direction, carried, sampler, specular_at);
}

SpecularWalk walk_from_eye(const RayScene& scene, const glm::dvec3& origin,
                           const glm::dvec3& direction, Sampler& sampler) {
    return walk(scene, scene.trace(origin, direction), direction, Carried::radiance, sampler,
                specular_at, &origin);
}

SpecularWalk walk_strongest(const RayScene& scene, const glm::dvec3& origin,
                            const glm::dvec3& direction) {
    Stronger stronger;
    return walk(scene, scene.trace(origin, direction), direction, Carried::radiance, stronger,
                seen_specular_at, &origin);
}

}  // namespace raybundle
