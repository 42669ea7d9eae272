// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "zones/exchange_rays.h"
#include "zones/zone_levels.h"
#include "zones/zone_partition.h"

namespace raybundle {

/// What light reflected by surfaces adds to each patch, known before any bundle has carried it: the
/// radiosity (Goral et al. 1984) of cells of patches, with the exchange between them that rays have
/// found. A cell is what a cluster of patches has of a zone. A surface that sees nothing but black
/// ones, or nothing but the sky, gets nothing.
class FirstReflection {
  public:
    FirstReflection() = default;
    /// base_colour: of patches, share of the light that they reflect. areas: of patches, m².
    /// rays_per_area: that start on a patch, 1/m².
    FirstReflection(const ZonePartition& partition, std::span<const ExchangeRay> rays,
                    std::span<const glm::vec3> base_colour, std::span<const float> areas,
                    std::span<const double> rays_per_area);

    /// Irradiance of each patch, radiance units; nothing where no rays are known. emitted: flux per
    /// area that patches send whatever bundles bring, radiance units. radiance_unit: cd/m².
    [[nodiscard]] std::vector<glm::vec4> irradiance(std::span<const glm::vec4> emitted,
                                                    double radiance_unit) const;

    /// Whether any two surfaces that see each other reflect light: else nothing visible lacks it.
    [[nodiscard]] bool matters() const { return matters_; }

  private:
    /// A ray between two patches.
    struct Line {
        std::uint32_t from = 0, to = 0;  // patches
        double area = 0.0;  // m²: of either patch, whose light it carries to the other
    };

    void bound_exchange();
    void make_fluxes_irradiance(std::vector<glm::dvec3>& flux) const;
    [[nodiscard]] std::vector<glm::dvec3> direct(std::span<const glm::vec4> emitted,
                                                 double radiance_unit) const;
    [[nodiscard]] std::vector<glm::dvec3> reflected_once(
        std::span<const glm::dvec3> irradiance) const;
    [[nodiscard]] double flux_of(std::span<const glm::dvec3> irradiance) const;

    bool matters_ = false;
    std::vector<Line> lines_;
    std::vector<glm::vec3> base_colour_;  // of patches
    std::vector<std::uint32_t> cell_;     // of patches
    std::vector<double> cell_areas_;      // m², see bound_exchange()
    std::vector<glm::dvec3> sky_;         // of cells: flux that comes from it, cd/m² m²
};

}  // namespace raybundle
