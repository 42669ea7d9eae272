// SPDX-License-Identifier: Apache-2.0
// Surfaces that deflect a ray into one direction or two, not into a lobe: ideal and nearly ideal
// mirrors, and glass. Directions are unit vectors; cosines are those with the surface's normal.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "scene/scene.h"

namespace raybundle {

enum class SpecularKind {
    none,
    mirror,  ///< reflects into the mirrored direction
    coat,    ///< a smooth clear coat or the surface of a polished dielectric, over what reflects
             ///< otherwise
    pane,    ///< a thin pane of glass: lets light straight through
    glass    ///< boundary of a glass body: refracts, absorbs on the way inside
};

/// What such a surface does with light.
struct SpecularSurface {
    SpecularKind kind = SpecularKind::none;
    glm::vec3 f0{0.0F};          ///< mirror, dielectric: reflectance at normal incidence
    float f90 = 0.0F;            ///< of the same at grazing angles
    float coat = 0.0F;           ///< share that a clear coat covers
    float ior = 1.5F;            ///< glass: index of refraction, of the inside over the outside
    glm::vec3 tint{1.0F};        ///< glass: factor of what passes the surface once
    glm::vec3 absorption{0.0F};  ///< body: 1/m inside

    [[nodiscard]] bool is_glass() const {
        return kind == SpecularKind::pane || kind == SpecularKind::glass;
    }
};

/// Lobes of metals, dielectrics and clear coats up to this roughness are mirror images: through
/// bundles so narrow a lobe settles too slowly.
constexpr float mirror_roughness = 0.1F;

/// What a material is for view rays: a mirror where nothing but a narrow metallic lobe reflects,
/// glass where at least half of the light is transmitted (KHR_materials_transmission; a body where
/// KHR_materials_volume gives it a thickness), a coat where a smooth one lies over anything else or
/// that has a narrow lobe itself. What emits or is cut out is none. base_colour: linear, of the
/// whole surface.
SpecularSurface specular_surface(const Material& material, const glm::vec3& base_colour);

/// Kind of a material; cheap.
SpecularKind specular_kind(const Material& material);
/// Whether a material is a thin pane or the boundary of a body of glass.
inline bool is_glass(const Material& material) {
    const SpecularKind kind = specular_kind(material);
    return kind == SpecularKind::pane || kind == SpecularKind::glass;
}
/// Whether a clear coat is a mirror rather than a lobe.
bool has_smooth_coat(const Material& material);
/// Whether the lobe below it is, or that of a material without one, the same all over the surface.
bool has_smooth_lobe(const Material& material);
/// Whether view rays see that, where the surface does not emit and nothing is cut out of it: not
/// where a map turns the normals, which they do not know, or below a rough coat.
bool shows_smooth_lobe(const Material& material);
/// Whether any material has a kind; whether one is a coat, or would be were it no lamp, which can
/// be put out; and whether one is more than that.
bool has_specular_surfaces(const Scene& scene);
bool has_coats(const Scene& scene);
bool has_mirror_or_glass(const Scene& scene);
bool has_glass(const Scene& scene);

/// What a mirror or a coat reflects into the mirrored direction: Schlick's approximation, as the
/// lobes of scene/material/brdf.h have it, with what a smooth lobe below a smooth coat adds.
glm::vec3 mirror_reflectance(const SpecularSurface& surface, float cosine);

/// Share of unpolarised light that the boundary of two dielectrics reflects (Fresnel 1823).
/// relative_index: of the far side over the near side. 1 where all is reflected.
float fresnel_reflectance(float cosine, float relative_index);

/// Direction behind the boundary (Snell 1621); nothing where all is reflected. direction: towards
/// the boundary; normal: on the near side.
std::optional<glm::vec3> refracted(const glm::vec3& direction, const glm::vec3& normal,
                                   float relative_index);

/// What a thin pane does with light: all reflections between its two faces are in it.
struct PaneShares {
    glm::vec3 reflected{0.0F};
    glm::vec3 transmitted{0.0F};
};
PaneShares pane_shares(const SpecularSurface& pane, float cosine);

/// Glass as bundles know it, which go straight through: of the light on a pane, or on one boundary
/// of a body, so much is not absorbed, by luminance. What is reflected goes on, too, as if as much
/// had come from the other side.
struct BundleGlass {
    float tint = 1.0F;  ///< luminance of what passes a pane or a whole body once; 1: all of it
    float ior = 1.5F;
    float surfaces = 1.0F;  ///< that share the absorption: 1 of a pane, 2 of a body

    [[nodiscard]] float passing_share(float cosine) const;
};

/// Every line through a body is as long as its mean chord, m.
BundleGlass bundle_glass(const SpecularSurface& glass, float mean_chord);
/// The same for a material of the scene, by its index; all of it passes where that is no glass.
BundleGlass bundle_glass(const Scene& scene, std::size_t material);

/// Mean chord 4 V/S of the bodies with a material (Cauchy), m; what the material says of its
/// thickness where the surfaces do not close.
float mean_chord(const Scene& scene, std::size_t material);

/// Whether any glass absorbs what passes.
bool has_absorbing_glass(const Scene& scene);

}  // namespace raybundle
