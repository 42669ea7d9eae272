// SPDX-License-Identifier: Apache-2.0
#include "trace/line_openings.h"

#include <algorithm>
#include <cmath>

#include "scene/mesh/patch_colour.h"

namespace raybundle {

namespace {

/// texel_at() of shaders/material/alpha_mask.glsl.
int texel_at(float coordinate, int size, bool repeat) {
    const float wrapped =
        repeat ? coordinate - std::floor(coordinate) : std::clamp(coordinate, 0.0F, 1.0F);
    return std::clamp(static_cast<int>(wrapped * static_cast<float>(size)), 0, size - 1);
}

/// The first of random_numbers_of() in shaders/common/random_hash.glsl.
float random_number_of(std::uint32_t a, std::uint32_t b) {
    glm::uvec3 v = glm::uvec3(a, b, 0x9e3779b9U) * 1664525U + 1013904223U;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16U;
    v.x += v.y * v.z;
    return static_cast<float>(v.x >> 8U) * 0x1.0p-24F;
}

}  // namespace

LineOpenings::LineOpenings(const Scene& scene)
    : materials_(scene.materials.size()), alphas_(scene.textures.size()) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        update(scene, i);
    }
}

void LineOpenings::update(const Scene& scene, std::size_t material) {
    const Material& source = scene.materials[material];
    Surface& surface = materials_[material];
    surface.is_glass = is_glass(source);
    surface.glass = bundle_glass(scene, material);
    surface.cutoff = 0.0F;
    const TextureSlot& slot = source.base_colour_texture;
    const std::optional<float> cutoff = texture_alpha_cutoff(source);
    if (!cutoff || slot.texture < 0) {
        return;
    }
    surface.alpha = static_cast<std::size_t>(slot.texture);
    const Texture& texture = scene.textures[surface.alpha];
    if (texture.width <= 0 || texture.height <= 0) {
        return;
    }
    surface.cutoff = *cutoff;
    surface.uv_from_mesh_uv = slot.uv_from_mesh_uv;
    Alpha& alpha = alphas_[surface.alpha];
    if (alpha.values.empty()) {
        alpha = {texture.width, texture.height, texture.repeat_u, texture.repeat_v, {}};
        for (std::size_t i = 3; i < texture.rgba.size(); i += 4) {
            alpha.values.push_back(texture.rgba[i]);
        }
    }
}

bool LineOpenings::cut_out(std::size_t material, const glm::vec2& mesh_uv) const {
    const Surface& surface = materials_[material];
    if (surface.cutoff <= 0.0F) {
        return false;
    }
    const Alpha& alpha = alphas_[surface.alpha];
    const glm::vec3 uv = surface.uv_from_mesh_uv * glm::vec3(mesh_uv, 1.0F);
    const auto column = static_cast<std::size_t>(texel_at(uv.x, alpha.width, alpha.repeat_u));
    const auto row = static_cast<std::size_t>(texel_at(uv.y, alpha.height, alpha.repeat_v));
    const std::uint8_t value = alpha.values[row * static_cast<std::size_t>(alpha.width) + column];
    return static_cast<float>(value) / 255.0F < surface.cutoff;
}

bool LineOpenings::passes(std::size_t material, std::uint32_t facet, float cosine,
                          const TraceRules& rules, std::uint32_t line) const {
    const Surface& surface = materials_[material];
    if (!surface.is_glass || rules.glass == GlassRule::shown) {
        return false;
    }
    if (surface.glass.tint <= 0.0F || rules.glass == GlassRule::clear) {
        return surface.glass.tint > 0.0F;
    }
    return surface.glass.tint >= 1.0F ||
           random_number_of(facet, line ^ rules.bundle) < surface.glass.passing_share(cosine);
}

}  // namespace raybundle
