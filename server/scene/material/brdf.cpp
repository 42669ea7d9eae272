// SPDX-License-Identifier: Apache-2.0
#include "scene/material/brdf.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scene/material/base_colour.h"
#include "scene/material/ggx_albedo.h"
#include "scene/material/specular_surface.h"

namespace raybundle {
namespace {

constexpr float dielectric_f0 = 0.04F;  // index of refraction 1.5

/// Cosines below this count as this: f_r is then finite, and it reflects nothing worth the name.
constexpr float min_cosine = 1e-6F;

/// A Lambert part gets light through its coating only if it is worth a division.
constexpr float min_mean_transmission = 1e-4F;

/// Share by which a dielectric is darkened per specular factor, so that the error of the tabulated
/// albedo in its coupling (at most 2.3e-3, of a smooth lobe near grazing) creates no energy.
constexpr float energy_margin = 3e-3F;

/// f90 of the lobe of a Lambert surface below a clear coat: it reflects nothing.
constexpr float no_lobe = 1e-6F;

float max_component(const glm::vec3& v) {
    return std::max({v.r, v.g, v.b});
}

ReflectanceModel max_phong_model(const MaxPhong& phong) {
    ReflectanceModel model;
    model.f0 = glm::clamp(phong.specular, 0.0F, 1.0F);
    if (model.f0 == glm::vec3(0.0F)) {
        return model;
    }
    model.lobe.kind = LobeKind::max_phong;
    model.lobe.exponent =
        std::clamp(phong.exponent, MaxPhong::min_exponent, MaxPhong::max_exponent);
    model.lobe.alpha = std::sqrt(2.0F / (model.lobe.exponent + 2.0F));
    return model;
}

float inverse_mean_transmission(const SpecularLobe& lobe) {
    if (lobe.coat.factor > 0.0F) {
        constexpr int steps = 512;
        double sum = 0.0;
        for (int i = 0; i < steps; ++i) {
            const float cosine = (static_cast<float>(i) + 0.5F) / steps;
            sum += 2.0 / steps * static_cast<double>(cosine * transmission(lobe, cosine));
        }
        const auto passed = static_cast<float>(sum);
        return passed > min_mean_transmission ? 1.0F / passed : 0.0F;
    }
    const LobeAlbedo mean = ggx_mean_albedo(lobe.alpha);
    const float passed = 1.0F - lobe.coating.x * mean.scale - lobe.coating.y * mean.bias;
    return passed > min_mean_transmission ? 1.0F / passed : 0.0F;
}

/// D V of a GGX lobe, and Schlick's p.
struct GgxFactors {
    float lobe, p;
};

GgxFactors ggx_factors(float alpha, const glm::vec3& w_in, const glm::vec3& w_out) {
    const float cos_in = std::max(w_in.z, min_cosine);
    const float cos_out = std::max(w_out.z, min_cosine);
    const float a2 = alpha * alpha;
    // The half vector, not normalised: its length is 2 v.h.
    const glm::vec2 across = glm::vec2(w_in) + glm::vec2(w_out);
    const float along = cos_in + cos_out;
    const float sine2 = glm::dot(across, across);
    const float length2 = sine2 + along * along;
    // D = a^2 / (pi (sin^2 + a^2 cos^2)^2): no cancellation near the mirrored direction.
    const float spread = (sine2 + a2 * along * along) / length2;
    const float distribution = a2 / (glm::pi<float>() * spread * spread);
    const float smith = cos_in * std::sqrt(a2 + (1.0F - a2) * cos_out * cos_out) +
                        cos_out * std::sqrt(a2 + (1.0F - a2) * cos_in * cos_in);
    const float grazing = std::max(0.0F, 1.0F - 0.5F * std::sqrt(length2));
    const float p = grazing * grazing * grazing * grazing * grazing;
    return {0.5F * distribution / smith, p};
}

glm::vec3 ggx(const Brdf& brdf, const glm::vec3& w_in, const glm::vec3& w_out) {
    const GgxFactors base = ggx_factors(brdf.lobe.alpha, w_in, w_out);
    const glm::vec3 value = (brdf.f0 * (1.0F - base.p) + brdf.lobe.f90 * base.p) * base.lobe;
    const ClearCoat& coat = brdf.lobe.coat;
    if (coat.factor <= 0.0F) {
        return value;
    }
    const float passed =
        std::min(coat_transmission(coat, w_in.z), coat_transmission(coat, w_out.z));
    if (coat.strength <= 0.0F) {
        return passed * value;
    }
    const GgxFactors top = ggx_factors(coat.alpha, w_in, w_out);
    return passed * value + coat.strength * (dielectric_f0 * (1.0F - top.p) + top.p) * top.lobe;
}

glm::vec3 max_phong(const Brdf& brdf, const glm::vec3& w_in, const glm::vec3& w_out) {
    const float n = brdf.lobe.exponent;
    // 1 - cosine between w_out and the mirrored w_in, by their distance: exact where it is small.
    const glm::vec3 apart(w_in.x + w_out.x, w_in.y + w_out.y, w_in.z - w_out.z);
    const float gap = 0.5F * glm::dot(apart, apart);
    if (gap >= 1.0F) {
        return glm::vec3(0.0F);
    }
    const float power = std::exp(n * std::log1p(-gap));
    return brdf.f0 * (power * (n + 2.0F) /
                      (2.0F * glm::pi<float>() * std::max({w_in.z, w_out.z, min_cosine})));
}

/// What a dielectric surface reflects.
struct Specular {
    glm::vec3 colour;
    float factor;
};

/// The model without SpecularLobe::inverse_mean.
ReflectanceModel uncoupled_model(const Specular& dielectric_surface, float metallic,
                                 float roughness) {
    metallic = std::clamp(metallic, 0.0F, 1.0F);
    const float specular = std::clamp(dielectric_surface.factor, 0.0F, 1.0F);
    ReflectanceModel model;
    if (metallic <= 0.0F && specular <= 0.0F) {
        return model;
    }
    roughness = std::clamp(roughness, min_roughness, 1.0F);
    const glm::vec3 dielectric =
        glm::clamp(dielectric_f0 * dielectric_surface.colour, 0.0F, 1.0F) * specular;
    const float dielectric_share = (1.0F - metallic) * (1.0F - energy_margin * specular);
    model.f0 = dielectric_share * dielectric;
    model.f0_share = metallic;
    model.lambert_share = dielectric_share;
    model.lobe.kind = LobeKind::ggx;
    model.lobe.alpha = roughness * roughness;
    model.lobe.f90 = dielectric_share * specular + metallic;
    if (metallic < 1.0F) {
        model.lobe.coating = glm::vec2(max_component(dielectric), specular);
    }
    return model;
}

ClearCoat coat_of(const Material& material) {
    ClearCoat coat;
    coat.factor = std::clamp(material.clear_coat, 0.0F, 1.0F);
    if (coat.factor > 0.0F) {
        const float roughness = std::clamp(material.clear_coat_roughness, min_roughness, 1.0F);
        coat.alpha = roughness * roughness;
        coat.strength = material.clear_coat_traced ? 0.0F : (1.0F - energy_margin) * coat.factor;
    }
    return coat;
}

/// The same model below a coat, still without inverse_mean.
ReflectanceModel below(const ClearCoat& coat, ReflectanceModel model) {
    if (coat.factor <= 0.0F) {
        return model;
    }
    if (model.lobe.kind == LobeKind::none) {
        model.lobe.kind = LobeKind::ggx;
        model.lobe.alpha = coat.alpha;
        model.lobe.f90 = no_lobe;
    }
    const float share = 1.0F - energy_margin * coat.factor;
    model.f0 *= share;
    model.f0_share *= share;
    model.lambert_share *= share;
    model.lobe.f90 *= share;
    model.lobe.coat = coat;
    return model;
}

/// Whether the Lambert part gets less light than falls on the surface.
bool is_coated(const SpecularLobe& lobe) {
    return lobe.coating != glm::vec2(0.0F) || lobe.coat.factor > 0.0F;
}

ReflectanceModel metallic_roughness_model(const Material& material,
                                          const glm::vec2& metallic_roughness) {
    ReflectanceModel model = uncoupled_model({material.specular_colour, material.specular},
                                             metallic_roughness.x, metallic_roughness.y);
    model.lobe_traced = material.lobe_traced;
    model = below(coat_of(material), model);
    if (is_coated(model.lobe)) {
        model.lobe.inverse_mean = inverse_mean_transmission(model.lobe);
    }
    return model;
}

/// Multiplies the whole BRDF.
ReflectanceModel scaled(ReflectanceModel model, float factor) {
    model.f0 *= factor;
    model.f0_share *= factor;
    model.lambert_share *= factor;
    model.lobe.f90 *= factor;
    model.lobe.coat.strength *= factor;
    return model;
}

ReflectanceModel black_model() {
    ReflectanceModel model;
    model.lambert_share = 0.0F;
    return model;
}

}  // namespace

ReflectanceModel reflectance_model(const Material& material) {
    return reflectance_model(material, {material.metallic, material.roughness});
}

ReflectanceModel reflectance_model(const Material& material, const glm::vec2& metallic_roughness) {
    if (material.unlit ||
        is_glass(material)) {  // scene/material/specular_surface.h knows what glass does
        return black_model();
    }
    return scaled(material.max_phong ? max_phong_model(*material.max_phong)
                                     : metallic_roughness_model(material, metallic_roughness),
                  material.reflectance);
}

TexturedReflectance::TexturedReflectance(const Material& material)
    : specular_colour_(material.specular_colour),
      specular_(material.specular),
      reflectance_(material.reflectance),
      coat_(coat_of(material)) {
    for (int i = 0; i <= steps; ++i) {
        const float roughness = static_cast<float>(i) / static_cast<float>(steps);
        inverse_mean_[static_cast<std::size_t>(i)] =
            metallic_roughness_model(material, {0.0F, roughness}).lobe.inverse_mean;
    }
}

ReflectanceModel TexturedReflectance::at(const glm::vec2& metallic_roughness) const {
    ReflectanceModel model = below(
        coat_,
        uncoupled_model({specular_colour_, specular_}, metallic_roughness.x, metallic_roughness.y));
    if (is_coated(model.lobe)) {
        const float place =
            std::clamp(metallic_roughness.y, 0.0F, 1.0F) * static_cast<float>(steps);
        const auto first = static_cast<std::size_t>(std::min(static_cast<int>(place), steps - 1));
        model.lobe.inverse_mean = glm::mix(inverse_mean_[first], inverse_mean_[first + 1],
                                           place - static_cast<float>(first));
    }
    return scaled(model, reflectance_);
}

Brdf make_brdf(const ReflectanceModel& model, const glm::vec3& base_colour) {
    const glm::vec3 colour = glm::clamp(base_colour, 0.0F, max_albedo);
    Brdf brdf{model.lambert_share * colour, model.f0 + model.f0_share * colour, model.lobe};
    if (model.lobe_traced) {
        brdf.f0 = glm::vec3(0.0F);
        brdf.lobe.f90 = 0.0F;
    }
    if (model.lobe.kind == LobeKind::max_phong) {
        const glm::vec3 scale = glm::min(glm::vec3(1.0F), max_albedo / (brdf.lambert + brdf.f0));
        brdf.lambert *= scale;
        brdf.f0 *= scale;
    }
    return brdf;
}

Brdf make_brdf(const Material& material, const glm::vec3& base_colour) {
    return make_brdf(reflectance_model(material), base_colour);
}

float transmission(const SpecularLobe& lobe, float cosine) {
    const float passed = coat_transmission(lobe.coat, cosine);
    if (lobe.coating == glm::vec2(0.0F)) {
        return passed;
    }
    const LobeAlbedo albedo = ggx_albedo(lobe.alpha, cosine);
    return passed * (1.0F - lobe.coating.x * albedo.scale - lobe.coating.y * albedo.bias);
}

float coat_transmission(const ClearCoat& coat, float cosine) {
    if (coat.factor <= 0.0F) {
        return 1.0F;
    }
    const LobeAlbedo albedo = ggx_albedo(coat.alpha, cosine);
    return 1.0F - coat.factor * (dielectric_f0 * albedo.scale + albedo.bias);
}

float coat_albedo(const ClearCoat& coat, float cosine) {
    return coat.factor > 0.0F
               ? coat.strength / coat.factor * (1.0F - coat_transmission(coat, cosine))
               : 0.0F;
}

glm::vec3 evaluate(const Brdf& brdf, const glm::vec3& w_in, const glm::vec3& w_out) {
    return evaluate(brdf, w_in, w_out,
                    transmission(brdf.lobe, w_in.z) * transmission(brdf.lobe, w_out.z));
}

glm::vec3 evaluate(const Brdf& brdf, const glm::vec3& w_in, const glm::vec3& w_out, float passed) {
    if (!(w_in.z > 0.0F && w_out.z > 0.0F)) {
        return glm::vec3(0.0F);
    }
    const glm::vec3 diffuse = brdf.lambert * (passed * brdf.lobe.inverse_mean / glm::pi<float>());
    switch (brdf.lobe.kind) {
        case LobeKind::ggx:
            return diffuse + ggx(brdf, w_in, w_out);
        case LobeKind::max_phong:
            return diffuse + max_phong(brdf, w_in, w_out);
        case LobeKind::none:
            break;
    }
    return diffuse;
}

}  // namespace raybundle
