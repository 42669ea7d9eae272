// SPDX-License-Identifier: Apache-2.0
#include "solution/reflectance_tables.h"

#include <algorithm>
#include <array>

#include "gpu/egl_context.h"
#include "gpu/layouts.h"
#include "scene/base_colour.h"
#include "scene/patch_colour.h"
#include "scene/specular_surface.h"

namespace raybundle {
namespace {

static_assert(reflectance_nodes == REFLECTANCE_NODES);
static_assert(max_albedo == static_cast<float>(MAX_ALBEDO));
static_assert(static_cast<int>(LobeKind::none) == LOBE_NONE &&
              static_cast<int>(LobeKind::ggx) == LOBE_GGX &&
              static_cast<int>(LobeKind::max_phong) == LOBE_MAX_PHONG);
static_assert(sizeof(ReflectanceNode) == sizeof(glm::vec4));

constexpr std::size_t texels_per_record = sizeof(layout::Reflectance) / sizeof(glm::vec4);

/// A random bundle seldom meets the one direction in which a mirror throws light, and then far too
/// much: between surfaces mirrors reflect into a lobe of this roughness.
constexpr float transported_roughness = 0.4F;

ReflectanceModel transported_model(const Material& material) {
    if (specular_kind(material) != SpecularKind::mirror) {
        return reflectance_model(material);
    }
    Material rough = material;
    rough.roughness = transported_roughness;
    return reflectance_model(rough);
}

/// What a material's table is made for. All Lambert surfaces share one.
Brdf representative(const Scene& scene, const Material& material) {
    const ReflectanceModel model = transported_model(material);
    return model.lobe.kind == LobeKind::none ? Brdf{}
                                             : make_brdf(model, mean_base_colour(scene, material));
}

using Key = std::array<float, 13>;

Key key_of(const Brdf& b) {
    return {b.lambert.r,
            b.lambert.g,
            b.lambert.b,
            b.f0.r,
            b.f0.g,
            b.f0.b,
            b.lobe.alpha,
            b.lobe.exponent,
            b.lobe.f90,
            b.lobe.coating.x,
            b.lobe.coating.y,
            b.lobe.inverse_mean,
            static_cast<float>(b.lobe.kind)};
}

layout::Reflectance record_of(const ReflectanceModel& model, std::size_t first_texel, bool glossy) {
    const SpecularLobe& lobe = model.lobe;
    const float width = lobe.kind == LobeKind::max_phong ? lobe.exponent : lobe.alpha;
    return {glm::vec4(model.f0, model.f0_share),
            glm::vec4(width, lobe.f90, model.lambert_share, lobe.inverse_mean),
            glm::vec4(grazing_scale(lobe.alpha), static_cast<float>(first_texel),
                      static_cast<float>(lobe.kind), glossy ? 1.0F : 0.0F)};
}

}  // namespace

ReflectanceTables::ReflectanceTables(const Scene& scene) {
    bool max_phong = false;
    for (const Material& material : scene.materials) {
        table_of_material_.push_back(table_for(scene, material));
        models_.push_back(transported_model(material));
        const LobeKind kind = models_.back().lobe.kind;
        specular_ |= kind != LobeKind::none;
        any_glossy_ |= glossy(models_.size() - 1);
        max_phong |= kind == LobeKind::max_phong;
    }
    if (max_phong) {
        defines_.emplace_back("MAX_PHONG 1");
    }
    upload();
}

/// Index of the table of a material, which is integrated where none is like it.
std::size_t ReflectanceTables::table_for(const Scene& scene, const Material& material) {
    const Brdf brdf = representative(scene, material);
    const Key key = key_of(brdf);
    const auto known = std::find(keys_.begin(), keys_.end(), key);
    if (known != keys_.end()) {
        return static_cast<std::size_t>(known - keys_.begin());
    }
    keys_.push_back(key);
    tables_.emplace_back(brdf);
    return tables_.size() - 1;
}

bool ReflectanceTables::covers(const Scene& scene, std::size_t material) const {
    const Brdf brdf = representative(scene, scene.materials[material]);
    if (brdf.lobe.kind == LobeKind::none || any_glossy_) {
        return true;
    }
    return specular_ && ReflectanceTable(brdf).mean_importance() <= gloss_threshold;
}

void ReflectanceTables::update(const Scene& scene, std::size_t material) {
    // The old table goes where nobody else has it: while a colour is dragged there would be more
    // and more of them.
    const std::size_t old = table_of_material_[material];
    const bool shared = std::count(table_of_material_.begin(), table_of_material_.end(), old) > 1;
    const Brdf brdf = representative(scene, scene.materials[material]);
    if (!shared && std::find(keys_.begin(), keys_.end(), key_of(brdf)) == keys_.end()) {
        keys_[old] = key_of(brdf);
        tables_[old] = ReflectanceTable(brdf);
    } else {
        table_of_material_[material] = table_for(scene, scene.materials[material]);
    }
    models_[material] = transported_model(scene.materials[material]);
    upload();
}

void ReflectanceTables::upload() {
    const std::size_t records = texels_per_record * models_.size();
    const std::size_t texels = records + reflectance_nodes * tables_.size();
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
    // Texel numbers travel as floats.
    constexpr std::size_t exact_in_float = 1U << 24U;
    if (texels > std::min(static_cast<std::size_t>(limit), exact_in_float)) {
        throw GpuError("the scene has too many materials: " + std::to_string(texels) +
                       " texels of reflectance do not fit into a buffer texture");
    }
    std::vector<layout::Reflectance> record;
    for (std::size_t i = 0; i < models_.size(); ++i) {
        record.push_back(
            record_of(models_[i], records + reflectance_nodes * table_of_material_[i], glossy(i)));
    }
    buffer_ = Buffer("reflectance", texels * sizeof(glm::vec4));
    buffer_.write<layout::Reflectance>(record, 0);
    for (std::size_t i = 0; i < tables_.size(); ++i) {
        buffer_.write(tables_[i].nodes(),
                      (records + reflectance_nodes * i) * sizeof(ReflectanceNode));
    }
    texture_ = create_buffer_texture("reflectance", GL_RGBA32F, buffer_);
}

void ReflectanceTables::bind() const {
    glBindTextureUnit(UNIT_REFLECTANCE, texture_.get());
}

}  // namespace raybundle
