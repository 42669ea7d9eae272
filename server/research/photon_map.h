// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "reference/ray_scene.h"
#include "reference/scattering.h"

namespace raybundle {

/// Light that has arrived at a surface. Own space of the ray scene.
struct Photon {
    glm::vec3 position{0.0F};
    glm::vec3 normal{0.0F};  ///< geometric, of the surface
    glm::vec3 from{0.0F};    ///< to where it came from, unit
    glm::vec3 power{0.0F};   ///< lm per unit of own area
};

/// Photons in a kd-tree (Bentley 1975), for density estimation (Jensen 2001, "Realistic Image
/// Synthesis Using Photon Mapping", ch. 6 and 7).
class PhotonMap {
  public:
    PhotonMap() = default;
    explicit PhotonMap(std::vector<Photon> photons);

    /// Radiance that a point reflects of the light in the map: the `nearest` photons, none farther
    /// than `radius`, over the disc that holds them. Only photons on surfaces that face about the
    /// same way count, so that nothing leaks through walls or round corners; along a floor it does,
    /// under a wall that stands on it, as far as the radius. If `nearest` are found
    /// the farthest one only says how large the disc is: the density is then right in the mean
    /// where it is even.
    [[nodiscard]] glm::dvec3 reflected(const SurfacePoint& point, const Scattering& scattering,
                                       std::size_t nearest, double radius) const;

    [[nodiscard]] std::size_t size() const { return photons_.size(); }

  private:
    struct Found {
        float square;  // of the distance
        std::size_t photon;
    };
    struct Query;

    void arrange(std::size_t first, std::size_t last);
    void search(std::size_t first, std::size_t last, Query& query) const;
    static void take(Query& query, const Found& found);

    std::vector<Photon> photons_;  // [first, last): the middle one divides the others
    std::vector<unsigned char> axes_;
};

}  // namespace raybundle
