// SPDX-License-Identifier: Apache-2.0
#include "solution/reflectance_tables.h"

#include <algorithm>
#include <array>
#include <limits>

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

constexpr float transported_roughness = 0.4F;

/// What a material's table is made for. All Lambert surfaces share one. Of a grid, its sharpest
/// lobe.
Brdf representative(const Scene& scene, const Material& material) {
    const ReflectanceModel model =
        has_reflectance_grid(material)
            ? reflectance_model(material, ReflectanceGrid(scene, material).low)
            : transported_model(material);
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

ReflectanceModel transported_model(const Material& material) {
    if (specular_kind(material) != SpecularKind::mirror) {
        return reflectance_model(material);
    }
    Material rough = material;
    rough.roughness = transported_roughness;
    return reflectance_model(rough);
}

ReflectanceTables::ReflectanceTables(const Scene& scene) {
    bool max_phong = false;
    for (const Material& material : scene.materials) {
        table_of_record_.push_back(table_for(scene, material));
        models_.push_back(transported_model(material));
        glossy_.push_back(table(models_.size() - 1).mean_importance() > gloss_threshold);
        grids_.emplace_back();
        first_record_.push_back(0);
        max_phong |= models_.back().lobe.kind == LobeKind::max_phong;
    }
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (has_reflectance_grid(scene.materials[i])) {
            add_grid(scene, i);
        }
        any_glossy_ |= glossy_[i];
    }
    specular_ = std::any_of(models_.begin(), models_.end(), [](const ReflectanceModel& model) {
        return model.lobe.kind != LobeKind::none;
    });
    if (max_phong) {
        defines_.emplace_back("MAX_PHONG 1");
    }
    if (models_.size() > scene.materials.size()) {
        defines_.emplace_back("REFLECTANCE_TEXTURED 1");
    }
    upload();
}

/// Records and tables for all places of a material's grid; their number stays while factors change.
void ReflectanceTables::add_grid(const Scene& scene, std::size_t material) {
    const ReflectanceGrid grid(scene, scene.materials[material]);
    const std::size_t first_table = tables_.size();
    first_record_[material] = models_.size();
    for (std::size_t i = 0; i < grid.size(); ++i) {
        models_.emplace_back();
        table_of_record_.push_back(first_table + grid.roughness_level(i));
    }
    Key unlike;
    unlike.fill(std::numeric_limits<float>::quiet_NaN());
    keys_.insert(keys_.end(), static_cast<std::size_t>(grid.roughness_levels), unlike);
    tables_.insert(tables_.end(), static_cast<std::size_t>(grid.roughness_levels),
                   ReflectanceTable(Brdf{}));
    fill_grid(scene, material);
}

void ReflectanceTables::fill_grid(const Scene& scene, std::size_t material) {
    const Material& source = scene.materials[material];
    const ReflectanceGrid& grid = grids_[material].emplace(scene, source);
    const std::size_t first = first_record_[material];
    for (std::size_t i = 0; i < grid.size(); ++i) {
        models_[first + i] = reflectance_model(source, grid.at(i));
    }
    const std::vector<ReflectanceTable> tables = grid_tables(grid, scene, source);
    std::copy(tables.begin(), tables.end(),
              tables_.begin() + static_cast<std::ptrdiff_t>(table_of_record_[first]));
    glossy_[material] = std::any_of(tables.begin(), tables.end(), [](const ReflectanceTable& t) {
        return t.mean_importance() > gloss_threshold;
    });
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
    const std::size_t old = table_of_record_[material];
    const bool shared = std::count(table_of_record_.begin(), table_of_record_.end(), old) > 1;
    const Brdf brdf = representative(scene, scene.materials[material]);
    if (!shared && std::find(keys_.begin(), keys_.end(), key_of(brdf)) == keys_.end()) {
        keys_[old] = key_of(brdf);
        tables_[old] = ReflectanceTable(brdf);
    } else {
        table_of_record_[material] = table_for(scene, scene.materials[material]);
    }
    models_[material] = transported_model(scene.materials[material]);
    glossy_[material] = table(material).mean_importance() > gloss_threshold;
    if (grids_[material]) {
        fill_grid(scene, material);
    }
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
    const auto first_node = [&](std::size_t i) {
        return records + reflectance_nodes * table_of_record_[i];
    };
    for (std::size_t i = 0; i < grids_.size(); ++i) {
        record.push_back(record_of(models_[i], first_node(i), glossy(i)));
        if (grids_[i]) {
            record.back().f0.x = static_cast<float>(first_record_[i]);
            record.back().table.z = static_cast<float>(LOBE_TEXTURED);
        }
    }
    for (std::size_t i = grids_.size(); i < models_.size(); ++i) {
        record.push_back(record_of(models_[i], first_node(i), false));
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
