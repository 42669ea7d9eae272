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

/// What light reflected by the zones' surfaces adds to each patch, known before any bundle has
/// carried it: surfaces of a zone that see the zone's light send it to where rays from them end.
/// Each cluster of patches gets what ends on it; all of a zone together get what the zone will
/// have. A surface that sees nothing but black ones, or nothing but the sky, gets nothing.
class FirstReflection {
  public:
    FirstReflection() = default;
    /// base_colour: of patches, share of the light that they reflect.
    FirstReflection(const ZonePartition& partition, std::span<const ExchangeRay> rays,
                    std::span<const glm::vec3> base_colour);

    /// Irradiance of each patch, radiance units; nothing where no rays are known. zones: with
    /// nothing incident but what lights and the sky send. incident: of each zone in the end,
    /// radiance units m². areas: of patches, m².
    [[nodiscard]] std::vector<glm::vec4> irradiance(const ZonePartition& partition,
                                                    std::span<const ZoneFlux> zones,
                                                    std::span<const glm::dvec3> incident,
                                                    std::span<const float> areas) const;

    /// Whether any two surfaces that see each other reflect light: else nothing visible lacks it.
    [[nodiscard]] bool matters() const { return matters_; }

  private:
    bool matters_ = false;
    unsigned zones_ = 0;
    std::vector<glm::vec3> seen_;  // [cluster * zones + zone]: area of rays times reflectance
    std::vector<float> area_;      // of all rays of a cluster
};

/// The same zones, with nothing incident but what lights and the sky send, as rays say.
std::vector<ZoneFlux> direct_light(std::vector<ZoneFlux> zones,
                                   std::span<const ZoneExchange> exchange,
                                   std::span<const ZoneSky> sky);

}  // namespace raybundle
