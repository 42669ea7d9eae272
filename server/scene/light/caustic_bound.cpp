// SPDX-License-Identifier: Apache-2.0
#include "scene/light/caustic_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "scene/contact/world_triangle.h"
#include "scene/material/specular_surface.h"

namespace raybundle {
namespace {

using std::numbers::pi;
constexpr std::size_t most_spheres = 16;  // as CausticLights aims at

struct Sphere {
    glm::dvec3 centre{0.0};
    double radius = 0.0;
};

/// Round the mirrors and the glass of each object.
std::vector<Sphere> specular_spheres(const Scene& scene) {
    std::vector<bool> specular;
    for (const Material& material : scene.materials) {
        const SpecularKind kind = specular_kind(material);
        specular.push_back(kind != SpecularKind::none && kind != SpecularKind::coat);
    }
    std::vector<Bounds> boxes(scene.objects.size());
    for (const Triangle& triangle : scene.triangles) {
        if (specular[triangle.material]) {
            for (const glm::dvec3& corner : world_corners(scene, triangle)) {
                boxes[triangle.object].add(glm::vec3(corner));
            }
        }
    }
    std::erase_if(boxes, [](const Bounds& box) { return box.empty(); });
    for (std::size_t i = most_spheres; i < boxes.size(); ++i) {
        boxes[most_spheres - 1].add(boxes[i].min);
        boxes[most_spheres - 1].add(boxes[i].max);
    }
    boxes.resize(std::min(boxes.size(), most_spheres));
    std::vector<Sphere> spheres;
    for (const Bounds& box : boxes) {
        spheres.push_back(
            {glm::dvec3(box.centre()), 0.5 * static_cast<double>(glm::length(box.extent()))});
    }
    return spheres;
}

/// Square of the sine of half the angle under which a sphere is seen from a distance; 1 from
/// inside.
double sine2(const Sphere& sphere, double distance) {
    return distance > sphere.radius ? sphere.radius * sphere.radius / (distance * distance) : 1.0;
}

/// Of a Lambert emitter: the sphere covers at most sin² of its light, all of it faced.
double emitter_share(const std::vector<Sphere>& spheres, const std::array<glm::dvec3, 3>& corners) {
    const glm::dvec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    double reach = 0.0;
    for (const glm::dvec3& corner : corners) {
        reach = std::max(reach, glm::length(corner - middle));
    }
    double share = 0.0;
    for (const Sphere& sphere : spheres) {
        share += sine2(sphere, glm::length(sphere.centre - middle) - reach);
    }
    return std::min(share, 1.0);
}

double point_flux(const std::vector<Sphere>& spheres, const PlacedLight& light) {
    const auto flux = static_cast<double>(luminance(glm::vec3(light.flux())));
    if (light.profile) {
        return flux;  // may be as narrow as it likes
    }
    const auto intensity = static_cast<double>(luminance(glm::vec3(light.intensity)));
    double solid_angle = 0.0;
    for (const Sphere& sphere : spheres) {
        const double s2 = sine2(sphere, glm::length(sphere.centre - light.position));
        solid_angle += s2 < 1.0 ? 2.0 * pi * (1.0 - std::sqrt(1.0 - s2)) : 4.0 * pi;
    }
    return std::min(flux, intensity * solid_angle);
}

double radius_of(const Scene& scene) {
    return 0.5 * static_cast<double>(glm::length(scene.bounds.extent()));
}

}  // namespace

double directional_flux(const Scene& scene, double illuminance) {
    return illuminance * pi * radius_of(scene) * radius_of(scene);
}

double flux_on_specular_surfaces(const Scene& scene) {
    const std::vector<Sphere> spheres = specular_spheres(scene);
    if (spheres.empty()) {
        return 0.0;
    }
    double flux = 0.0;
    for (const Triangle& triangle : scene.triangles) {
        const Material& material = scene.materials[triangle.material];
        const auto radiance = static_cast<double>(luminance(material.emission));
        if (radiance > 0.0) {
            const auto corners = world_corners(scene, triangle);
            const double area = 0.5 * glm::length(double_area(corners));
            flux += (two_sided(scene, triangle) ? 2.0 : 1.0) * pi * radiance * area *
                    emitter_share(spheres, corners);
        }
    }
    double discs = 0.0;
    for (const Sphere& sphere : spheres) {
        discs += sphere.radius * sphere.radius;
    }
    const double disc_share =
        std::min(discs / std::max(radius_of(scene) * radius_of(scene), 1e-30), 1.0);
    for (const PunctualLight& light : scene.punctual_lights) {
        const PlacedLight placed = place_light(scene, light);
        flux += light.kind == PunctualKind::directional
                    ? disc_share *
                          directional_flux(
                              scene, static_cast<double>(luminance(glm::vec3(placed.intensity))))
                    : point_flux(spheres, placed);
    }
    return flux;
}

}  // namespace raybundle
