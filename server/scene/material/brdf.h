// SPDX-License-Identifier: Apache-2.0
// Reflectance of surfaces. Directions are unit vectors away from the surface in its local frame,
// z = normal; w_in looks to where the light comes from. All BRDFs are isotropic and reciprocal.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "scene/scene.h"

namespace raybundle {

enum class LobeKind { none, ggx, max_phong };

/// A clear coat (KHR_materials_clearcoat) of index 1.5 over all the rest, with a GGX lobe of its
/// own.
struct ClearCoat {
    float alpha = 0.0F;   ///< roughness^2
    float factor = 0.0F;  ///< share of the surface that it covers; 0: there is none
    float strength =
        0.0F;  ///< factor of its lobe: of `factor`; 0 where view rays show what it reflects

    bool operator==(const ClearCoat&) const = default;
};

/// The specular part without its colour, and how much it takes from the Lambert part below it.
struct SpecularLobe {
    LobeKind kind = LobeKind::none;
    float alpha = 1.0F;         ///< GGX: roughness^2; max-Phong: of about the same width
    float exponent = 0.0F;      ///< max-Phong
    float f90 = 0.0F;           ///< GGX: reflectance at grazing angles
    glm::vec2 coating{0.0F};    ///< f0, f90 of the dielectric surface over the Lambert part
    float inverse_mean = 1.0F;  ///< 1 / mean over the hemisphere of transmission()
    ClearCoat coat;             ///< GGX only

    bool operator==(const SpecularLobe&) const = default;
};

/// A BRDF, 1/sr:
///
///   f_r = lambert/pi * t(cos_in) t(cos_out) / mean(t)  +  (f0 (1 - p) + f90 p) D V   (GGX)
///   f_r = lambert/pi  +  f0 (n + 2)/(2 pi) cos^n / max(cos_in, cos_out)              (max-Phong)
///
/// with p = (1 - v.h)^5 (Schlick), D the GGX distribution, V the height-correlated Smith term (glTF
/// 2.0 appendix B), and t = transmission().
///
/// Appendix B multiplies the Lambert part by 1 - p instead of the t. That creates energy: at
/// grazing angles a smooth dielectric reflects nearly everything by its lobe and 95 % of `lambert`
/// again, an albedo of up to 1.9. Kelemen and Szirmay-Kalos 2001, "A Microfacet Based Coupled
/// Specular-Matte BRDF Model", couple both by the lobe's tabulated directional albedo instead: the
/// albedo is then lambert * t + lobe <= 1 at every angle. At normal incidence it differs from
/// appendix B's by less than 3 %, the light that a rough surface would lose between its facets.
///
/// Below a clear coat that reflects c(cos) of the light from an angle, u = 1 - c passes. The lobe
/// is multiplied by min(u(cos_in), u(cos_out)), t by u, and the coat adds a lobe of f0 0.04, f90 1.
/// glTF dims what lies below by the Fresnel term at one angle alone, the viewer's, which is not
/// reciprocal. The least of both angles is, equals glTF's in the mirrored direction, and creates no
/// energy below any lobe, as u(cos_in) u(cos_out) / mean(u) or a root would; the light that is
/// reflected back and forth below the coat is missing in the lobe (4 % of its albedo at most), as
/// in glTF. The Lambert part has it: a white dielectric still reflects everything.
struct Brdf {
    glm::vec3 lambert{0.0F};  ///< albedo of the Lambert part alone
    glm::vec3 f0{0.0F};       ///< GGX: reflectance at normal incidence; max-Phong: albedo there
    SpecularLobe lobe;

    bool operator==(const Brdf&) const = default;
};

/// What a material's BRDF is apart from its base colour, which may come from a texture.
struct ReflectanceModel {
    glm::vec3 f0{0.0F};          ///< part of Brdf::f0 that has a colour of its own
    float f0_share = 0.0F;       ///< share of the base colour in Brdf::f0 (metals)
    float lambert_share = 1.0F;  ///< share of the base colour in Brdf::lambert
    SpecularLobe lobe;
    bool lobe_traced = false;  ///< a BRDF has no GGX lobe: view rays show what it would reflect
};

/// glTF 2.0 appendix B (metallic-roughness) with KHR_materials_specular, or max-Phong over a
/// Lambert base; black for unlit materials and glass. Roughness is at least min_roughness. Some 10
/// us; the first call for a glossy material also integrates the GGX table.
ReflectanceModel reflectance_model(const Material& material);

/// The model where a texture gives metalness (x) and roughness (y) in the place of the factors.
ReflectanceModel reflectance_model(const Material& material, const glm::vec2& metallic_roughness);

/// The same for many values of one material: its costly part is tabulated over roughness.
class TexturedReflectance {
  public:
    explicit TexturedReflectance(const Material& material);
    [[nodiscard]] ReflectanceModel at(const glm::vec2& metallic_roughness) const;

  private:
    static constexpr int steps = 128;
    glm::vec3 specular_colour_;
    float specular_, reflectance_;
    ClearCoat coat_;
    std::array<float, steps + 1> inverse_mean_{};  // over roughness, 0 to 1
};

/// Cheap. base_colour: factor times texture, linear; clamped to 0..max_albedo. A max-Phong lobe and
/// its Lambert base are scaled down together where they would reflect more than max_albedo.
Brdf make_brdf(const ReflectanceModel& model, const glm::vec3& base_colour);
Brdf make_brdf(const Material& material, const glm::vec3& base_colour);

/// Share of the light from an angle that the specular lobe and the coat let pass to the Lambert
/// part.
float transmission(const SpecularLobe& lobe, float cosine);

/// Share that the clear coat lets pass; 1 without one. And what its lobe reflects.
float coat_transmission(const ClearCoat& coat, float cosine);
float coat_albedo(const ClearCoat& coat, float cosine);

/// f_r, 1/sr. 0 if either direction is not above the horizon; finite everywhere.
glm::vec3 evaluate(const Brdf& brdf, const glm::vec3& w_in, const glm::vec3& w_out);
/// The same where transmission() is known at both angles: `passed` is its product.
glm::vec3 evaluate(const Brdf& brdf, const glm::vec3& w_in, const glm::vec3& w_out, float passed);

struct BrdfSample {
    glm::vec3 w_in{0.0F, 0.0F, 1.0F};  ///< may lie below the horizon, where evaluate() is 0
    float pdf = 0.0F;                  ///< 1/sr, of pdf(); 0: no direction, w_out was below
};

/// Draws w_in for a given w_out: a lobe (visible normals for GGX, Heitz 2018; cos^n round the
/// mirrored direction for max-Phong) if `choice` is below its share, else the cosine. u and choice:
/// uniform in [0, 1), independent.
BrdfSample sample(const Brdf& brdf, const glm::vec3& w_out, const glm::vec2& u, float choice);

/// Density of sample(), 1/sr; integrates to 1 over the whole sphere. 0 if w_out is not above the
/// horizon.
float pdf(const Brdf& brdf, const glm::vec3& w_in, const glm::vec3& w_out);

/// The lobe alone: a direction for a uniformly distributed point of the unit disc, and its density
/// over the sphere, 1/sr. Not for LobeKind::none; w_out above the horizon. Points with opposite
/// disc.y give directions that mirror each other in the plane of w_out and the normal.
glm::vec3 lobe_direction(const SpecularLobe& lobe, const glm::vec3& w_out, const glm::vec2& disc);
float lobe_density(const SpecularLobe& lobe, const glm::vec3& w_in, const glm::vec3& w_out);

/// The same of the clear coat's lobe.
glm::vec3 coat_direction(const ClearCoat& coat, const glm::vec3& w_out, const glm::vec2& disc);
float coat_density(const ClearCoat& coat, const glm::vec3& w_in, const glm::vec3& w_out);

/// The direction above a point of the unit disc: of density cos/pi for uniform points.
glm::vec3 cosine_direction(const glm::vec2& disc);

}  // namespace raybundle
