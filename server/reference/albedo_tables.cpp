// SPDX-License-Identifier: Apache-2.0
#include "reference/albedo_tables.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "scene/mesh/patch_colour.h"

namespace raybundle {

AlbedoTables::AlbedoTables(const Scene& scene) {
    for (const Material& material : scene.materials) {
        grids_.emplace_back();
        if (has_reflectance_grid(material)) {
            table_of_material_.push_back(tables_.size());
            std::vector<ReflectanceTable> levels =
                grid_tables(grids_.back().emplace(scene, material), scene, material);
            tables_.insert(tables_.end(), levels.begin(), levels.end());
            glossy_ = true;
            continue;
        }
        const ReflectanceModel model = reflectance_model(material);
        const bool lambert = model.lobe.kind == LobeKind::none;
        const Brdf brdf = lambert ? Brdf{} : make_brdf(model, mean_base_colour(scene, material));
        const auto found = std::find_if(tables_.begin(), tables_.end(),
                                        [&](const auto& table) { return table.brdf() == brdf; });
        table_of_material_.push_back(
            static_cast<std::size_t>(std::distance(tables_.begin(), found)));
        if (found == tables_.end()) {
            tables_.emplace_back(brdf);
        }
        glossy_ |= !lambert;
    }
}

const ReflectanceTable& AlbedoTables::table(std::uint32_t material,
                                            const Scattering& scattering) const {
    std::size_t index = table_of_material_[material];
    if (const std::optional<ReflectanceGrid>& grid = grids_[material]) {
        const float roughness = std::sqrt(scattering.brdf().lobe.alpha);
        index += grid->roughness_level(grid->nearest({grid->low.x, roughness}));
    }
    return tables_[index];
}

glm::dvec3 AlbedoTables::albedo(std::uint32_t material, const Scattering& scattering) const {
    return glm::dvec3(
        table(material, scattering).albedo(scattering.brdf(), scattering.outgoing_cosine()));
}

double AlbedoTables::importance(std::uint32_t material, const Scattering& scattering) const {
    return table(material, scattering).importance(scattering.outgoing_cosine());
}

}  // namespace raybundle
