// SPDX-License-Identifier: Apache-2.0
#include "scene/material/specular_surface.h"

#include <algorithm>
#include <cmath>

#include "scene/contact/world_triangle.h"
#include "scene/material/base_colour.h"
#include "scene/material/brdf.h"
#include "scene/mesh/patch_colour.h"

namespace raybundle {
namespace {

constexpr float least_metal = 0.999F;         // share: below, the Lambert part shows
constexpr float least_transmission = 0.5F;    // share: below, the surface is opaque
constexpr float least_index = 1.0F;           // glass in air
constexpr float most_index = 5.0F;            // no glass bends more
constexpr float darkest_attenuation = 1e-6F;  // colour: absorption stays finite
constexpr float coat_f0 = 0.04F;              // index of refraction 1.5
constexpr float clear_tint = 0.9999F;         // more is no absorption
constexpr float least_tint = 1e-6F;           // 0 stands for no glass on the GPU

/// Schlick's (1 - cosine)^5.
float schlick(float cosine) {
    const float grazing = std::clamp(1.0F - cosine, 0.0F, 1.0F);
    return grazing * grazing * grazing * grazing * grazing;
}

/// Beer and Lambert: colour is what is left after `distance`, m.
glm::vec3 absorption_of(const Material& material) {
    if (!(material.attenuation_distance > 0.0F) || !std::isfinite(material.attenuation_distance)) {
        return glm::vec3(0.0F);
    }
    const glm::vec3 left = glm::clamp(material.attenuation_colour, darkest_attenuation, 1.0F);
    return -glm::log(left) / material.attenuation_distance;
}

}  // namespace

SpecularKind specular_kind(const Material& material) {
    if (material.unlit || material.max_phong || material.alpha_mode != AlphaMode::opaque ||
        material.emission != glm::vec3(0.0F)) {
        return SpecularKind::none;
    }
    if (material.metallic >= least_metal && has_smooth_lobe(material)) {
        return SpecularKind::mirror;
    }
    if (material.metallic >= least_metal || material.transmission < least_transmission) {
        const bool smooth = has_smooth_coat(material) || shows_smooth_lobe(material);
        return smooth ? SpecularKind::coat : SpecularKind::none;
    }
    return material.thickness > 0.0F ? SpecularKind::glass : SpecularKind::pane;
}

SpecularSurface specular_surface(const Material& material, const glm::vec3& base_colour) {
    SpecularSurface surface;
    surface.kind = specular_kind(material);
    surface.coat = surface.is_glass() ? 0.0F : std::clamp(material.clear_coat, 0.0F, 1.0F);
    if (surface.kind == SpecularKind::mirror) {
        surface.f0 = clamped_base_colour(base_colour) * material.reflectance;
        surface.f90 = 1.0F;
    } else if (surface.kind == SpecularKind::coat && shows_smooth_lobe(material)) {
        const Brdf brdf = make_brdf(material, base_colour);
        surface.f0 = brdf.f0;
        surface.f90 = brdf.lobe.f90;
    } else if (surface.is_glass()) {
        surface.ior = std::clamp(material.ior, least_index, most_index);
        const glm::vec3 absorption = absorption_of(material);
        const glm::vec3 colour = glm::clamp(base_colour, 0.0F, 1.0F) *
                                 (material.reflectance * material.transmission) *
                                 glm::exp(absorption * std::min(material.thickness, 0.0F));
        // Through a body light passes two boundaries: its colour is that of both.
        surface.tint = surface.kind == SpecularKind::glass ? glm::sqrt(colour) : colour;
        surface.absorption = absorption;
    }
    return surface;
}

bool has_specular_surfaces(const Scene& scene) {
    return has_coats(scene) || has_mirror_or_glass(scene);
}

bool has_coats(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(), [](Material m) {
        m.emission = glm::vec3(0.0F);
        return specular_kind(m) == SpecularKind::coat;
    });
}

bool has_smooth_coat(const Material& material) {
    return material.clear_coat > 0.0F && material.clear_coat_roughness <= mirror_roughness;
}

bool has_smooth_lobe(const Material& material) {
    return !material.unlit && !material.max_phong && material.reflectance > 0.0F &&
           (material.metallic > 0.0F || material.specular > 0.0F) &&
           material.roughness <= mirror_roughness &&
           material.metallic_roughness_texture.texture < 0;
}

bool shows_smooth_lobe(const Material& material) {
    const bool covered = material.clear_coat > 0.0F && !has_smooth_coat(material);
    return has_smooth_lobe(material) && !covered && material.normal_texture.texture < 0;
}

bool has_mirror_or_glass(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(), [](const Material& m) {
        const SpecularKind kind = specular_kind(m);
        return kind != SpecularKind::none && kind != SpecularKind::coat;
    });
}

bool has_glass(const Scene& scene) {
    return std::any_of(scene.materials.begin(), scene.materials.end(), is_glass);
}

glm::vec3 mirror_reflectance(const SpecularSurface& surface, float cosine) {
    const float p = schlick(cosine);
    const float coat = surface.coat * (coat_f0 + (1.0F - coat_f0) * p);
    const glm::vec3 below = surface.f0 + (glm::vec3(surface.f90) - surface.f0) * p;
    return glm::vec3(coat) + (1.0F - coat) * below;
}

float fresnel_reflectance(float cosine, float relative_index) {
    cosine = std::clamp(cosine, 0.0F, 1.0F);
    const float sine2 = (1.0F - cosine * cosine) / (relative_index * relative_index);
    if (sine2 >= 1.0F) {
        return 1.0F;
    }
    const float behind = std::sqrt(1.0F - sine2);
    const float parallel = (relative_index * cosine - behind) / (relative_index * cosine + behind);
    const float across = (cosine - relative_index * behind) / (cosine + relative_index * behind);
    return 0.5F * (parallel * parallel + across * across);
}

std::optional<glm::vec3> refracted(const glm::vec3& direction, const glm::vec3& normal,
                                   float relative_index) {
    const float cosine = -glm::dot(direction, normal);
    const float sine2 = (1.0F - cosine * cosine) / (relative_index * relative_index);
    if (sine2 >= 1.0F) {
        return std::nullopt;
    }
    return glm::normalize(direction / relative_index +
                          (cosine / relative_index - std::sqrt(1.0F - sine2)) * normal);
}

float BundleGlass::passing_share(float cosine) const {
    // Reflected and transmitted share of pane_shares().
    const float f = fresnel_reflectance(cosine, ior);
    const float passing = f + (1.0F - f) * (1.0F - f) * tint / std::max(1.0F - f * tint, 1e-6F);
    return std::pow(passing, 1.0F / surfaces);
}

BundleGlass bundle_glass(const SpecularSurface& glass, float mean_chord) {
    BundleGlass result;
    if (!glass.is_glass()) {
        return result;
    }
    const bool body = glass.kind == SpecularKind::glass;
    const glm::vec3 left =
        body ? glass.tint * glass.tint * glm::exp(-glass.absorption * mean_chord) : glass.tint;
    result.tint = std::clamp(luminance(left), least_tint, 1.0F);
    result.tint = result.tint >= clear_tint ? 1.0F : result.tint;
    result.ior = glass.ior;
    result.surfaces = body ? 2.0F : 1.0F;
    return result;
}

BundleGlass bundle_glass(const Scene& scene, std::size_t material) {
    const Material& m = scene.materials[material];
    if (!is_glass(m)) {
        return {};
    }
    const SpecularSurface glass = specular_surface(m, mean_base_colour(scene, m));
    const bool absorbs = glass.absorption != glm::vec3(0.0F);
    return bundle_glass(glass, absorbs ? mean_chord(scene, material) : 0.0F);
}

float mean_chord(const Scene& scene, std::size_t material) {
    constexpr double open = 1e-3;  // of the area: the area vectors of a closed surface add up to 0
    double volume6 = 0.0;
    double area2 = 0.0;
    glm::dvec3 sum(0.0);
    for (const Triangle& t : scene.triangles) {
        if (t.material != material) {
            continue;
        }
        const std::array<glm::dvec3, 3> corners = world_corners(scene, t);
        const glm::dvec3 across = double_area(corners);
        volume6 += glm::dot(corners[0], across);
        area2 += glm::length(across);
        sum += across;
    }
    if (glm::length(sum) > open * area2 || !(area2 > 0.0)) {
        return scene.materials[material].thickness;
    }
    return static_cast<float>(4.0 * std::abs(volume6 / 6.0) / (0.5 * area2));
}

bool has_absorbing_glass(const Scene& scene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (bundle_glass(scene, i).tint < 1.0F) {
            return true;
        }
    }
    return false;
}

PaneShares pane_shares(const SpecularSurface& pane, float cosine) {
    // The sum of the geometric series of reflections inside; light is tinted at every crossing.
    const float f = fresnel_reflectance(cosine, pane.ior);
    PaneShares shares;
    for (int c = 0; c < 3; ++c) {
        const float t = pane.tint[c];
        const float series = 1.0F / std::max(1.0F - f * f * t * t, 1e-6F);
        shares.transmitted[c] = (1.0F - f) * (1.0F - f) * t * series;
        shares.reflected[c] = f + f * (1.0F - f) * (1.0F - f) * t * t * series;
    }
    return shares;
}

}  // namespace raybundle
