// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scene/material/brdf.h"
#include "scene/material/ggx_albedo.h"

namespace raybundle {
namespace {

/// Where both parts reflect, neither is sampled more rarely than this: an estimate of the shares
/// that is off must not starve a part.
constexpr float min_share = 0.1F;

/// Share of the lobe in what the surface reflects to w_out, without its coat.
float lobe_share(const Brdf& brdf, float cos_out) {
    float specular = luminance(brdf.f0);
    if (brdf.lobe.kind == LobeKind::none) {
        return 0.0F;
    }
    if (brdf.lobe.kind == LobeKind::ggx) {
        const LobeAlbedo albedo = ggx_albedo(brdf.lobe.alpha, cos_out);
        specular = specular * albedo.scale + brdf.lobe.f90 * albedo.bias;
    }
    if (brdf.lambert == glm::vec3(0.0F)) {
        return 1.0F;
    }
    const float diffuse = luminance(brdf.lambert) * transmission(brdf.lobe, cos_out);
    return std::clamp(specular / std::max(specular + diffuse, 1e-12F), min_share, 1.0F - min_share);
}

/// Share of the coat's lobe. What is below it, at most all the rest, is taken to be a half of that.
float coat_share(const Brdf& brdf, float cos_out) {
    const ClearCoat& coat = brdf.lobe.coat;
    if (coat.strength <= 0.0F) {
        return 0.0F;
    }
    const float reflected = coat_albedo(coat, cos_out);
    const float below = 0.5F * coat_transmission(coat, cos_out);
    return std::clamp(reflected / (reflected + below), min_share, 1.0F - min_share);
}

/// Heitz 2018, "Sampling the GGX Distribution of Visible Normals", listing 1; then mirrored.
glm::vec3 ggx_direction(float alpha, const glm::vec3& w_out, const glm::vec2& disc) {
    const glm::vec3 view = glm::normalize(glm::vec3(alpha * w_out.x, alpha * w_out.y, w_out.z));
    const float across2 = view.x * view.x + view.y * view.y;
    const glm::vec3 t1 = across2 > 0.0F ? glm::vec3(-view.y, view.x, 0.0F) / std::sqrt(across2)
                                        : glm::vec3(1.0F, 0.0F, 0.0F);
    const glm::vec3 t2 = glm::cross(view, t1);
    const float s = 0.5F * (1.0F + view.z);
    const float p1 = disc.y;
    const float p2 = (1.0F - s) * std::sqrt(std::max(0.0F, 1.0F - p1 * p1)) + s * disc.x;
    const glm::vec3 n =
        p1 * t1 + p2 * t2 + std::sqrt(std::max(0.0F, 1.0F - p1 * p1 - p2 * p2)) * view;
    const glm::vec3 half = glm::normalize(glm::vec3(alpha * n.x, alpha * n.y, std::max(0.0F, n.z)));
    return 2.0F * glm::dot(w_out, half) * half - w_out;
}

/// Visible normals, D G1(w_out) v.h / cos_out, over 4 v.h: the mirrored directions.
float ggx_density(float alpha, const glm::vec3& w_in, const glm::vec3& w_out) {
    const float a2 = alpha * alpha;
    const glm::vec3 half = w_in + w_out;
    const float length2 = glm::dot(half, half);
    if (half.z <= 0.0F || length2 <= 0.0F) {
        return 0.0F;
    }
    const float sine2 = half.x * half.x + half.y * half.y;
    const float spread = (sine2 + a2 * half.z * half.z) / length2;
    const float smith = w_out.z + std::sqrt(a2 + (1.0F - a2) * w_out.z * w_out.z);
    return a2 / (glm::pi<float>() * spread * spread * 2.0F * smith);
}

/// cos^n round the mirrored w_out.
glm::vec3 phong_direction(float exponent, const glm::vec3& w_out, const glm::vec2& disc) {
    const glm::vec3 axis(-w_out.x, -w_out.y, w_out.z);
    // Duff et al. 2017, "Building an Orthonormal Basis, Revisited"; axis.z >= 0.
    const float a = -1.0F / (1.0F + axis.z);
    const float b = axis.x * axis.y * a;
    const glm::vec3 t1(1.0F + axis.x * axis.x * a, b, -axis.x);
    const glm::vec3 t2(b, 1.0F + axis.y * axis.y * a, -axis.y);
    // 1 - r^2 is uniform in 0..1 as a random number is.
    const float r2 = glm::dot(disc, disc);
    const float cosine = std::pow(std::max(0.0F, 1.0F - r2), 1.0F / (exponent + 1.0F));
    const float sine_by_r = r2 > 0.0F ? std::sqrt((1.0F - cosine * cosine) / r2) : 0.0F;
    return sine_by_r * (disc.x * t1 + disc.y * t2) + cosine * axis;
}

float phong_density(float exponent, const glm::vec3& w_in, const glm::vec3& w_out) {
    const glm::vec3 apart(w_in.x + w_out.x, w_in.y + w_out.y, w_in.z - w_out.z);
    const float gap = 0.5F * glm::dot(apart, apart);
    return gap >= 1.0F ? 0.0F
                       : (exponent + 1.0F) / (2.0F * glm::pi<float>()) *
                             std::exp(exponent * std::log1p(-gap));
}

}  // namespace

glm::vec3 lobe_direction(const SpecularLobe& lobe, const glm::vec3& w_out, const glm::vec2& disc) {
    return lobe.kind == LobeKind::max_phong ? phong_direction(lobe.exponent, w_out, disc)
                                            : ggx_direction(lobe.alpha, w_out, disc);
}

float lobe_density(const SpecularLobe& lobe, const glm::vec3& w_in, const glm::vec3& w_out) {
    return lobe.kind == LobeKind::max_phong ? phong_density(lobe.exponent, w_in, w_out)
                                            : ggx_density(lobe.alpha, w_in, w_out);
}

glm::vec3 coat_direction(const ClearCoat& coat, const glm::vec3& w_out, const glm::vec2& disc) {
    return ggx_direction(coat.alpha, w_out, disc);
}

float coat_density(const ClearCoat& coat, const glm::vec3& w_in, const glm::vec3& w_out) {
    return ggx_density(coat.alpha, w_in, w_out);
}

glm::vec3 cosine_direction(const glm::vec2& disc) {
    return {disc.x, disc.y, std::sqrt(std::max(0.0F, 1.0F - glm::dot(disc, disc)))};
}

BrdfSample sample(const Brdf& brdf, const glm::vec3& w_out, const glm::vec2& u, float choice) {
    if (!(w_out.z > 0.0F)) {
        return {};
    }
    const float phi = 2.0F * glm::pi<float>() * u.y;
    const glm::vec2 disc = std::sqrt(u.x) * glm::vec2(std::cos(phi), std::sin(phi));
    const float coat = coat_share(brdf, w_out.z);
    const float lobe = coat + (1.0F - coat) * lobe_share(brdf, w_out.z);
    const glm::vec3 w_in = choice < coat   ? coat_direction(brdf.lobe.coat, w_out, disc)
                           : choice < lobe ? lobe_direction(brdf.lobe, w_out, disc)
                                           : cosine_direction(disc);
    return {w_in, pdf(brdf, w_in, w_out)};
}

float pdf(const Brdf& brdf, const glm::vec3& w_in, const glm::vec3& w_out) {
    if (!(w_out.z > 0.0F)) {
        return 0.0F;
    }
    const float share = lobe_share(brdf, w_out.z);
    const float cosine = (1.0F - share) * std::max(w_in.z, 0.0F) / glm::pi<float>();
    const float below =
        share > 0.0F ? cosine + share * lobe_density(brdf.lobe, w_in, w_out) : cosine;
    const float coat = coat_share(brdf, w_out.z);
    return coat > 0.0F ? (1.0F - coat) * below + coat * coat_density(brdf.lobe.coat, w_in, w_out)
                       : below;
}

}  // namespace raybundle
