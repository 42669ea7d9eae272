// SPDX-License-Identifier: Apache-2.0
#include "reference/specular_walk.h"

#include <cmath>

#include "scene/ggx_albedo.h"
#include "scene/patch_colour.h"
#include "scene/specular_surface.h"

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

glm::dvec3 reflected(const glm::dvec3& direction, const glm::dvec3& normal,
                     const glm::dvec3& geometric_normal) {
    const glm::dvec3 smooth = glm::reflect(direction, normal);
    return glm::dot(smooth, geometric_normal) > 0.0 ? smooth
                                                    : glm::reflect(direction, geometric_normal);
}

/// One surface; changes direction and weight.
std::optional<SurfacePoint> deflect(const RayScene& scene, SurfacePoint point, SpecularWalk& walk,
                                    const SpecularSurface& surface, Sampler& sampler) {
    glm::dvec3 normal = scene.shading_normal(point);
    if (glm::dot(normal, walk.direction) >= 0.0) {
        normal = point.normal;
    }
    if (surface.kind == SpecularKind::mirror) {
        const auto cosine = static_cast<float>(-glm::dot(walk.direction, normal));
        walk.weight *= glm::dvec3(mirror_reflectance(surface, cosine));
        walk.direction = reflected(walk.direction, normal, point.normal);
        return scene.trace_from(point, walk.direction);
    }
    const bool front = point.patch == point.triangle;
    const Ways ways = ways_at(surface, front, walk.direction, normal);
    const double chance =
        mean_of(ways.reflected) / (mean_of(ways.reflected) + mean_of(ways.passed));
    if (sampler.next() < chance) {
        walk.weight *= ways.reflected / chance;
        walk.direction = reflected(walk.direction, normal, point.normal);
    } else {
        walk.weight *= ways.passed / (1.0 - chance);
        walk.direction = ways.behind;
    }
    if (glm::dot(walk.direction, point.normal) < 0.0) {
        point.normal = -point.normal;  // rays start behind the surface
    }
    return scene.trace_from(point, walk.direction);
}

/// Share of the light that is left of a way to this point; one that ends at the back of a surface
/// of glass was inside of it.
glm::dvec3 left_of_way(const RayScene& scene, const glm::dvec3& from, const SurfacePoint& to) {
    const Material& material = scene.material(to);
    if (!is_glass(material) || to.patch == to.triangle) {
        return glm::dvec3(1.0);
    }
    const SpecularSurface inside =
        specular_surface(material, mean_base_colour(scene.scene(), material));
    const double metres = glm::distance(from, to.position) * std::sqrt(scene.square_metres());
    return glm::exp(-glm::dvec3(inside.absorption) * metres);
}

}  // namespace

SpecularWalk walk_specular(const RayScene& scene, const std::optional<SurfacePoint>& hit,
                           const glm::dvec3& direction, Sampler& sampler) {
    SpecularWalk walk{hit, direction};
    for (int i = 0; walk.hit; ++i) {
        const SpecularSurface surface = specular_at(scene, *walk.hit);
        if (surface.kind == SpecularKind::none) {
            break;
        }
        if (i == most_surfaces) {
            walk.weight = glm::dvec3(0.0);
            walk.hit.reset();
            break;
        }
        const SurfacePoint from = *walk.hit;
        walk.hit = deflect(scene, from, walk, surface, sampler);
        walk.passed = true;
        if (walk.hit) {
            walk.weight *= left_of_way(scene, from.position, *walk.hit);
        }
    }
    return walk;
}

}  // namespace raybundle
