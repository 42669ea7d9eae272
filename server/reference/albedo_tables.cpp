// SPDX-License-Identifier: Apache-2.0
#include "reference/albedo_tables.h"

#include <algorithm>
#include <iterator>

#include "scene/patch_colour.h"

namespace raybundle {

AlbedoTables::AlbedoTables(const Scene& scene) {
    for (const Material& material : scene.materials) {
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

glm::dvec3 AlbedoTables::albedo(std::uint32_t material, const Scattering& scattering) const {
    const ReflectanceTable& table = tables_[table_of_material_[material]];
    return glm::dvec3(table.albedo(scattering.brdf(), scattering.outgoing_cosine()));
}

double AlbedoTables::importance(std::uint32_t material, const Scattering& scattering) const {
    return tables_[table_of_material_[material]].importance(scattering.outgoing_cosine());
}

}  // namespace raybundle
