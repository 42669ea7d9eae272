// SPDX-License-Identifier: Apache-2.0
#include "reference/glass_walk.h"

#include <cmath>

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

/// One surface; changes direction and weight.
std::optional<SurfacePoint> deflect(const RayScene& scene, SurfacePoint point, GlassWalk& walk,
                                    const SpecularSurface& glass, Sampler& sampler) {
    const bool front = point.patch == point.triangle;
    glm::dvec3 normal = scene.shading_normal(point);
    if (glm::dot(normal, walk.direction) >= 0.0) {
        normal = point.normal;
    }
    const Ways ways = ways_at(glass, front, walk.direction, normal);
    const double chance =
        mean_of(ways.reflected) / (mean_of(ways.reflected) + mean_of(ways.passed));
    if (sampler.next() < chance) {
        walk.weight *= ways.reflected / chance;
        const glm::dvec3 smooth = glm::reflect(walk.direction, normal);
        walk.direction = glm::dot(smooth, point.normal) > 0.0
                             ? smooth
                             : glm::reflect(walk.direction, point.normal);
    } else {
        walk.weight *= ways.passed / (1.0 - chance);
        walk.direction = ways.behind;
    }
    if (glm::dot(walk.direction, point.normal) < 0.0) {
        point.normal = -point.normal;  // rays start behind the surface
    }
    return scene.trace_from(point, walk.direction);
}

}  // namespace

GlassWalk walk_through_glass(const RayScene& scene, const std::optional<SurfacePoint>& hit,
                             const glm::dvec3& direction, Sampler& sampler) {
    GlassWalk walk{hit, direction};
    for (int i = 0; i < most_surfaces && walk.hit && is_glass(scene.material(*walk.hit)); ++i) {
        const SurfacePoint from = *walk.hit;
        const Material& material = scene.material(from);
        const SpecularSurface glass =
            specular_surface(material, mean_base_colour(scene.scene(), material));
        walk.hit = deflect(scene, from, walk, glass, sampler);
        walk.passed = true;
        // A way that ends at the back of a surface of glass was inside.
        if (walk.hit && walk.hit->patch != walk.hit->triangle) {
            const Material& left = scene.material(*walk.hit);
            const SpecularSurface inside =
                specular_surface(left, mean_base_colour(scene.scene(), left));
            const double metres =
                glm::distance(from.position, walk.hit->position) * std::sqrt(scene.square_metres());
            walk.weight *= glm::exp(-glm::dvec3(inside.absorption) * metres);
        }
    }
    if (walk.hit && is_glass(scene.material(*walk.hit))) {
        walk.weight = glm::dvec3(0.0);
        walk.hit.reset();
    }
    return walk;
}

}  // namespace raybundle
