// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "reference/scattering.h"
#include "scene/material/reflectance_grid.h"
#include "scene/material/reflectance_table.h"

namespace raybundle {

/// Directional albedo and importance of all materials of a scene, by the tables of
/// scene/material/reflectance_table.h; one table for each distinct reflectance,
/// and one for each level of roughness of a material where that is textured.
class AlbedoTables {
  public:
    /// Some milliseconds for each distinct glossy material.
    explicit AlbedoTables(const Scene& scene);

    /// Share of the light from the scattering's outgoing direction that the point reflects; by
    /// reciprocity also its reflected radiance under uniform light of radiance 1.
    [[nodiscard]] glm::dvec3 albedo(std::uint32_t material, const Scattering& scattering) const;
    /// S of a material's mean colour for that direction; 0: Lambert.
    [[nodiscard]] double importance(std::uint32_t material, const Scattering& scattering) const;

    /// Whether any material has a specular lobe.
    [[nodiscard]] bool glossy() const { return glossy_; }

  private:
    [[nodiscard]] const ReflectanceTable& table(std::uint32_t material,
                                                const Scattering& scattering) const;

    std::vector<ReflectanceTable> tables_;
    std::vector<std::size_t> table_of_material_;         // the first of a grid's
    std::vector<std::optional<ReflectanceGrid>> grids_;  // of materials
    bool glossy_ = false;
};

}  // namespace raybundle
