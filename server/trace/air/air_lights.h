// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "scene/light/punctual_light.h"
#include "trace/air/air_scene.h"

namespace raybundle {

/// A place that light comes from, chosen at random.
struct AirLight {
    glm::vec3 position{0.0F};   ///< m; of a distant one not used
    glm::vec3 direction{0.0F};  ///< distant: unit, towards it; with an extent: its normal; else 0
    bool distant = false;
    const PlacedLight* punctual = nullptr;  ///< null: a place of an emitting side
    glm::vec3 radiance{0.0F};               ///< of that, cd/m²
    double density = 0.0;                   ///< chance of its choice; of a side per m²
};

/// Lamps that light the air: emitting sides and punctual lights (suns among them), chosen by what
/// they send. A snapshot.
class AirLights {
  public:
    /// emission: of sides, cd/m². punctual: in the space of the rays. diameter: of the scene, m.
    AirLights(const AirScene& scene, std::span<const glm::vec3> emission,
              std::vector<PlacedLight> punctual, float diameter);
    [[nodiscard]] bool empty() const { return chances_.empty() || chances_.back() <= 0.0; }
    [[nodiscard]] AirLight choose(AirRandom& random) const;

  private:
    struct Emitter {
        AirScene::Side side;
        glm::vec3 radiance{0.0F};
    };
    std::vector<Emitter> emitters_;
    std::vector<PlacedLight> punctual_;
    std::vector<double> chances_;  // cumulative, of emitters, then of punctual lights
};

}  // namespace raybundle
