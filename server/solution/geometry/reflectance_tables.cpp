// SPDX-License-Identifier: Apache-2.0
#include "solution/geometry/reflectance_tables.h"

#include <algorithm>
#include <array>
#include <limits>

#include "gpu/egl_context.h"
#include "gpu/layouts.h"
#include "scene/material/base_colour.h"
#include "scene/material/specular_surface.h"
#include "scene/mesh/patch_colour.h"

namespace raybundle {
namespace {

static_assert(reflectance_nodes == REFLECTANCE_NODES);
static_assert(max_albedo == static_cast<float>(MAX_ALBEDO));
static_assert(static_cast<int>(LobeKind::none) == LOBE_NONE &&
              static_cast<int>(LobeKind::ggx) == LOBE_GGX &&
              static_cast<int>(LobeKind::max_phong) == LOBE_MAX_PHONG);
static_assert(sizeof(ReflectanceNode) == sizeof(glm::vec4));

constexpr std::size_t texels_per_record = sizeof(layout::Reflectance) / sizeof(glm::vec4);

constexpr float transported_roughness = 0.4F;

/// Whether the lobe of the base is narrower than bundles carry, the same all over the surface.
bool has_narrow_lobe(const Material& material) {
    return !material.unlit && !material.max_phong && material.reflectance > 0.0F &&
           (material.metallic > 0.0F || material.specular > 0.0F) &&
           material.roughness < transported_roughness &&
           material.metallic_roughness_texture.texture < 0;
}

bool has_narrow_coat(const Material& material) {
    return material.clear_coat > 0.0F && material.clear_coat_roughness < transported_roughness;
}

/// A material as bundles know it.
Material as_transported(const Material& material) {
    Material rough = material;
    if (has_narrow_lobe(material)) {
        rough.roughness = transported_roughness;
    }
    if (has_narrow_coat(material)) {
        rough.clear_coat_roughness = transported_roughness;
    }
    return rough;
}

/// As pixels do, which view rays show the reflections of mirrors and of smooth surfaces over
/// others. Beside what a lamp sends its reflections are nothing.
Material as_shown(const Material& material) {
    const SpecularKind kind = specular_kind(material);
    if (kind == SpecularKind::mirror || material.emission != glm::vec3(0.0F)) {
        return as_transported(material);
    }
    Material shown = material;
    shown.clear_coat_traced = has_smooth_coat(material);
    shown.lobe_traced = kind == SpecularKind::coat && shows_smooth_lobe(material);
    return shown;
}

/// Whether patches and pixels may not know a material alike.
bool has_two_models(const Material& material) {
    const SpecularKind kind = specular_kind(material);
    return !is_glass(material) && (has_narrow_coat(material) ||
                                   (has_narrow_lobe(material) && kind != SpecularKind::mirror));
}

/// What a material's table is made for. All Lambert surfaces share one. Of a grid, its sharpest
/// lobe.
Brdf representative(const Scene& scene, const Material& material) {
    const ReflectanceModel model =
        has_reflectance_grid(material)
            ? reflectance_model(material, ReflectanceGrid(scene, material).low)
            : reflectance_model(material);
    return model.lobe.kind == LobeKind::none ? Brdf{}
                                             : make_brdf(model, mean_base_colour(scene, material));
}

/// Whether rays are drawn from a lobe that pixels know.
bool draws_lobe(const Scene& scene, const Material& material) {
    if (specular_kind(material) == SpecularKind::mirror) {
        return false;
    }
    const Material shown = as_shown(material);
    const ReflectanceModel model =
        has_reflectance_grid(material)
            ? reflectance_model(shown, ReflectanceGrid(scene, material).low)
            : reflectance_model(shown);
    const SpecularLobe& lobe = model.lobe;
    const auto narrow = [](float alpha) { return alpha <= static_cast<float>(DRAWN_ALPHA); };
    return (lobe.kind == LobeKind::ggx && !model.lobe_traced && narrow(lobe.alpha)) ||
           (lobe.coat.strength > 0.0F && narrow(lobe.coat.alpha));
}

bool has_coat(const ReflectanceTable& table) {
    return table.brdf().lobe.coat.factor > 0.0F;
}

/// first_texel, coat_texel: of its table's nodes and, below a clear coat, of the coat's.
layout::Reflectance record_of(const ReflectanceModel& model, std::size_t first_texel,
                              std::size_t coat_texel, bool glossy) {
    const SpecularLobe& lobe = model.lobe;
    const bool coated = lobe.coat.factor > 0.0F;
    const float width = lobe.kind == LobeKind::max_phong ? lobe.exponent : lobe.alpha;
    return {glm::vec4(model.f0, model.f0_share),
            glm::vec4(width, model.lobe_traced ? -lobe.f90 : lobe.f90, model.lambert_share,
                      lobe.inverse_mean),
            glm::vec4(coated ? static_cast<float>(coat_texel) : grazing_scale(lobe.alpha),
                      static_cast<float>(first_texel),
                      static_cast<float>(coated ? LOBE_COATED : static_cast<int>(lobe.kind)),
                      glossy ? 1.0F : 0.0F)};
}

/// Nodes of a clear coat, of its own grazing scale.
std::array<glm::vec4, reflectance_nodes> coat_nodes(const ClearCoat& coat) {
    std::array<glm::vec4, reflectance_nodes> nodes;
    for (int i = 0; i < reflectance_nodes; ++i) {
        const float cosine = cosine_of_node(static_cast<float>(i), grazing_scale(coat.alpha));
        nodes[static_cast<std::size_t>(i)] =
            glm::vec4(coat_transmission(coat, cosine), coat.alpha, coat.strength, coat.factor);
    }
    return nodes;
}

}  // namespace

ReflectanceModel transported_model(const Material& material) {
    return reflectance_model(as_transported(material));
}

ReflectanceTables::Key ReflectanceTables::key_of(const Brdf& b) {
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
            static_cast<float>(b.lobe.kind),
            b.lobe.coat.alpha,
            b.lobe.coat.factor,
            b.lobe.coat.strength};
}

ReflectanceTables::ReflectanceTables(const Scene& scene) {
    bool max_phong = false;
    bool gridded = false;
    for (const Material& material : scene.materials) {
        const Material shown = as_shown(material);
        table_of_record_.push_back(table_for(representative(scene, shown)));
        models_.push_back(reflectance_model(shown));
        grids_.emplace_back();
        first_record_.push_back(0);
        patch_record_.push_back(patch_record_.size());
        max_phong |= models_.back().lobe.kind == LobeKind::max_phong;
    }
    glossy_.resize(scene.materials.size(), false);
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        if (has_reflectance_grid(material)) {
            gridded = true;
            const ReflectanceGrid& grid = grids_[i].emplace(scene, material);
            first_record_[i] = add_grid(grid);
            patch_record_[i] = has_two_models(material) ? add_grid(grid) : first_record_[i];
        } else if (has_two_models(material)) {
            patch_record_[i] = models_.size();
            models_.emplace_back();
            table_of_record_.push_back(table_for(representative(scene, as_transported(material))));
        }
        fill_material(scene, i);
        any_glossy_ |= glossy_[i];
        draws_lobes_ = draws_lobes_ || (glossy_[i] && draws_lobe(scene, material));
    }
    specular_ = std::any_of(models_.begin(), models_.end(), [](const ReflectanceModel& model) {
        return model.lobe.kind != LobeKind::none;
    });
    if (max_phong) {
        defines_.emplace_back("MAX_PHONG 1");
    }
    if (gridded) {
        defines_.emplace_back("REFLECTANCE_TEXTURED 1");
    }
    if (std::any_of(tables_.begin(), tables_.end(), has_coat)) {
        defines_.emplace_back("CLEAR_COAT 1");
    }
    upload();
}

/// Records and tables for all places of a grid; their number stays while factors change. Returns
/// the first record.
std::size_t ReflectanceTables::add_grid(const ReflectanceGrid& grid) {
    const std::size_t first_table = tables_.size();
    const std::size_t first_record = models_.size();
    for (std::size_t i = 0; i < grid.size(); ++i) {
        models_.emplace_back();
        table_of_record_.push_back(first_table + grid.roughness_level(i));
    }
    Key unlike;
    unlike.fill(std::numeric_limits<float>::quiet_NaN());
    keys_.insert(keys_.end(), static_cast<std::size_t>(grid.roughness_levels), unlike);
    tables_.insert(tables_.end(), static_cast<std::size_t>(grid.roughness_levels),
                   ReflectanceTable(Brdf{}));
    return first_record;
}

/// Returns whether any place of the grid is glossy.
bool ReflectanceTables::fill_grid(const ReflectanceGrid& grid, const Scene& scene,
                                  const Material& source, std::size_t first_record) {
    for (std::size_t i = 0; i < grid.size(); ++i) {
        models_[first_record + i] = reflectance_model(source, grid.at(i));
    }
    const std::vector<ReflectanceTable> tables = grid_tables(grid, scene, source);
    std::copy(tables.begin(), tables.end(),
              tables_.begin() + static_cast<std::ptrdiff_t>(table_of_record_[first_record]));
    return std::any_of(tables.begin(), tables.end(), [](const ReflectanceTable& t) {
        return t.mean_importance() > gloss_threshold;
    });
}

/// All that depends on the factors of a material besides its own record and table.
void ReflectanceTables::fill_material(const Scene& scene, std::size_t material) {
    const Material& source = scene.materials[material];
    const auto first_is_glossy = [this](std::size_t record) {
        return table(record).mean_importance() > gloss_threshold;
    };
    if (!grids_[material]) {
        models_[patch_record_[material]] =
            patch_record_[material] == material ? models_[material] : transported_model(source);
        glossy_[material] = first_is_glossy(material) || first_is_glossy(patch_record_[material]);
        return;
    }
    const ReflectanceGrid& grid = grids_[material].emplace(scene, source);
    glossy_[material] = fill_grid(grid, scene, as_shown(source), first_record_[material]);
    if (patch_record_[material] != first_record_[material] &&
        fill_grid(grid, scene, as_transported(source), patch_record_[material])) {
        glossy_[material] = true;
    }
}

/// Index of the table of a BRDF, which is integrated where none is like it.
std::size_t ReflectanceTables::table_for(const Brdf& brdf) {
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
    const std::size_t shown = grids_[material] ? first_record_[material] : material;
    if (has_two_models(scene.materials[material]) && patch_record_[material] == shown) {
        return false;
    }
    const Brdf brdf = representative(scene, as_transported(scene.materials[material]));
    if (brdf.lobe.kind == LobeKind::none || any_glossy_) {
        return true;
    }
    return specular_ && ReflectanceTable(brdf).mean_importance() <= gloss_threshold;
}

/// Gives a record the table of another BRDF. The old one goes where nobody else has it: while a
/// colour is dragged there would be more and more of them.
void ReflectanceTables::replace_table(std::size_t record, const Brdf& brdf) {
    const std::size_t old = table_of_record_[record];
    const bool shared = std::count(table_of_record_.begin(), table_of_record_.end(), old) > 1;
    if (!shared && std::find(keys_.begin(), keys_.end(), key_of(brdf)) == keys_.end()) {
        keys_[old] = key_of(brdf);
        tables_[old] = ReflectanceTable(brdf);
    } else {
        table_of_record_[record] = table_for(brdf);
    }
}

void ReflectanceTables::update(const Scene& scene, std::size_t material) {
    const Material& source = scene.materials[material];
    const Material shown = as_shown(source);
    replace_table(material, representative(scene, shown));
    models_[material] = reflectance_model(shown);
    if (!grids_[material] && patch_record_[material] != material) {
        replace_table(patch_record_[material], representative(scene, as_transported(source)));
    }
    fill_material(scene, material);
    upload();
}

void ReflectanceTables::upload() {
    const std::size_t records = texels_per_record * models_.size();
    const std::size_t coats = records + reflectance_nodes * tables_.size();
    std::vector<std::size_t> coat_texel;  // of the tables
    std::size_t texels = coats;
    for (const ReflectanceTable& t : tables_) {
        coat_texel.push_back(texels);
        texels += has_coat(t) ? std::size_t{reflectance_nodes} : 0;
    }
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &limit);
    // Texel numbers travel as floats.
    constexpr std::size_t exact_in_float = 1U << 24U;
    if (texels > std::min(static_cast<std::size_t>(limit), exact_in_float)) {
        throw GpuError("the scene has too many materials: " + std::to_string(texels) +
                       " texels of reflectance do not fit into a buffer texture");
    }
    std::vector<layout::Reflectance> record;
    const auto first_node = [&](std::size_t i) {
        return records + reflectance_nodes * table_of_record_[i];
    };
    const auto add_record = [&](std::size_t i, bool glossy) {
        record.push_back(
            record_of(models_[i], first_node(i), coat_texel[table_of_record_[i]], glossy));
    };
    for (std::size_t i = 0; i < grids_.size(); ++i) {
        add_record(i, glossy(i));
        if (grids_[i]) {
            record.back().f0.x = static_cast<float>(first_record_[i]);
            record.back().table.z = static_cast<float>(LOBE_TEXTURED);
        }
    }
    for (std::size_t i = grids_.size(); i < models_.size(); ++i) {
        add_record(i, false);
    }
    buffer_ = Buffer("reflectance", texels * sizeof(glm::vec4));
    buffer_.write<layout::Reflectance>(record, 0);
    for (std::size_t i = 0; i < tables_.size(); ++i) {
        buffer_.write(tables_[i].nodes(),
                      (records + reflectance_nodes * i) * sizeof(ReflectanceNode));
        if (has_coat(tables_[i])) {
            buffer_.write<glm::vec4>(coat_nodes(tables_[i].brdf().lobe.coat),
                                     coat_texel[i] * sizeof(glm::vec4));
        }
    }
    texture_ = create_buffer_texture("reflectance", GL_RGBA32F, buffer_);
}

void ReflectanceTables::bind() const {
    glBindTextureUnit(UNIT_REFLECTANCE, texture_.get());
}

}  // namespace raybundle
