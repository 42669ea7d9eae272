// SPDX-License-Identifier: Apache-2.0
#include "reference/sampling/pane_shares.h"

#include <limits>
#include <optional>

#include "scene/material/specular_surface.h"
#include "scene/mesh/patch_colour.h"

namespace raybundle {
namespace {

constexpr int most_panes = 64;

/// distance: own space, along the unit direction.
glm::dvec3 share_along(const RayScene& scene, const glm::dvec3& from, const glm::dvec3& direction,
                       double distance) {
    glm::dvec3 share(1.0);
    std::optional<SurfacePoint> hit = scene.trace(from, direction);
    for (int i = 0; i < most_panes; ++i) {
        if (!hit || glm::distance(from, hit->position) >= distance) {
            return share;
        }
        const Material& material = scene.material(*hit);
        if (specular_kind(material) != SpecularKind::pane) {
            return glm::dvec3(0.0);
        }
        glm::dvec3 normal = scene.shading_normal(*hit);
        if (glm::dot(normal, direction) >= 0.0) {
            normal = hit->normal;
        }
        const SpecularSurface pane =
            specular_surface(material, mean_base_colour(scene.scene(), material));
        share *= glm::dvec3(
            pane_shares(pane, static_cast<float>(-glm::dot(direction, normal))).transmitted);
        SurfacePoint behind = *hit;
        behind.normal = -behind.normal;
        hit = scene.trace_from(behind, direction);
    }
    return glm::dvec3(0.0);
}

}  // namespace

glm::dvec3 share_through_panes(const RayScene& scene, const glm::dvec3& from,
                               const glm::dvec3& to) {
    if (scene.unobstructed(glm::vec3(from), glm::vec3(to))) {
        return glm::dvec3(1.0);
    }
    const double distance = glm::distance(from, to);
    return scene.has_panes() && distance > 0.0
               ? share_along(scene, from, (to - from) / distance, distance)
               : glm::dvec3(0.0);
}

glm::dvec3 share_through_panes_from_sky(const RayScene& scene, const glm::dvec3& from,
                                        const glm::dvec3& direction) {
    if (scene.open_towards(glm::vec3(from), direction)) {
        return glm::dvec3(1.0);
    }
    return scene.has_panes()
               ? share_along(scene, from, direction, std::numeric_limits<double>::infinity())
               : glm::dvec3(0.0);
}

}  // namespace raybundle
