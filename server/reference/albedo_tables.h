// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "reference/scattering.h"
#include "scene/reflectance_table.h"

namespace raybundle {

/// Directional albedo and importance of all materials of a scene, by the tables of
/// scene/reflectance_table.h; one table for each distinct reflectance.
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
    std::vector<ReflectanceTable> tables_;
    std::vector<std::size_t> table_of_material_;
    bool glossy_ = false;
};

}  // namespace raybundle
