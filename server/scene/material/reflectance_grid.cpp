// SPDX-License-Identifier: Apache-2.0
#include "scene/material/reflectance_grid.h"

#include <algorithm>
#include <cmath>

#include "scene/material/ggx_albedo.h"
#include "scene/mesh/patch_colour.h"

namespace raybundle {
namespace {

constexpr std::size_t levels_per_importance = 8;

struct Range {
    std::uint8_t low = 255, high = 0;

    void add(std::uint8_t value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    [[nodiscard]] int levels(int most) const { return low < high ? most : 1; }
    [[nodiscard]] glm::vec2 scaled(float factor) const {
        return glm::vec2(low, high) * (std::clamp(factor, 0.0F, 1.0F) / 255.0F);
    }
};

/// Nearest level of a value, between equal steps.
int level_of(float value, float lowest, float per_unit, int levels) {
    const float level = std::floor((value - lowest) * per_unit + 0.5F);
    return static_cast<int>(std::clamp(level, 0.0F, static_cast<float>(levels - 1)));
}

float per_unit(float low, float high, int levels) {
    return high > low ? static_cast<float>(levels - 1) / (high - low) : 0.0F;
}

}  // namespace

bool has_reflectance_grid(const Material& material) {
    return material.metallic_roughness_texture.texture >= 0 && !material.max_phong &&
           !material.unlit;
}

ReflectanceGrid::ReflectanceGrid(const Scene& scene, const Material& material) {
    const Texture& texture =
        scene.textures[static_cast<std::size_t>(material.metallic_roughness_texture.texture)];
    Range roughness;
    Range metallic;
    for (std::size_t i = 0; i + 3 < texture.rgba.size(); i += 4) {
        roughness.add(texture.rgba[i + 1]);
        metallic.add(texture.rgba[i + 2]);
    }
    roughness_levels = roughness.levels(most_roughness_levels);
    metallic_levels = metallic.levels(most_metallic_levels);
    const glm::vec2 m = metallic.scaled(material.metallic);
    const glm::vec2 r = glm::clamp(roughness.scaled(material.roughness), min_roughness, 1.0F);
    low = {m.x, r.x};
    high = {m.y, r.y};
}

glm::vec4 ReflectanceGrid::parameters() const {
    const float log_low = std::log(low.y);
    return {log_low, per_unit(log_low, std::log(high.y), roughness_levels), low.x,
            per_unit(low.x, high.x, metallic_levels)};
}

std::size_t ReflectanceGrid::nearest(const glm::vec2& metallic_roughness) const {
    const glm::vec4 p = parameters();
    const float roughness = std::clamp(metallic_roughness.y, min_roughness, 1.0F);
    const auto r =
        static_cast<std::size_t>(level_of(std::log(roughness), p.x, p.y, roughness_levels));
    const auto m =
        static_cast<std::size_t>(level_of(metallic_roughness.x, p.z, p.w, metallic_levels));
    return r * static_cast<std::size_t>(metallic_levels) + m;
}

glm::vec2 ReflectanceGrid::at(std::size_t index) const {
    const auto place = [](std::size_t level, int levels) {
        return levels > 1 ? static_cast<float>(level) / static_cast<float>(levels - 1) : 0.0F;
    };
    const auto columns = static_cast<std::size_t>(metallic_levels);
    return {glm::mix(low.x, high.x, place(index % columns, metallic_levels)),
            low.y * std::pow(high.y / low.y, place(index / columns, roughness_levels))};
}

std::vector<ReflectanceTable> grid_tables(const ReflectanceGrid& grid, const Scene& scene,
                                          const Material& material) {
    const glm::vec3 colour = mean_base_colour(scene, material);
    const auto levels = static_cast<std::size_t>(grid.roughness_levels);
    const float metallic = 0.5F * (grid.low.x + grid.high.x);
    const auto brdf_of = [&](std::size_t level) {
        const std::size_t index = level * static_cast<std::size_t>(grid.metallic_levels);
        return make_brdf(reflectance_model(material, {metallic, grid.at(index).y}), colour);
    };
    std::vector<ReflectanceTable> tables;
    tables.reserve(levels);
    for (std::size_t level = 0; level < levels; ++level) {
        if (level % levels_per_importance == 0) {
            tables.emplace_back(brdf_of(level));
        } else {
            tables.emplace_back(brdf_of(level), tables[level - level % levels_per_importance]);
        }
    }
    return tables;
}

}  // namespace raybundle
