// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "scene/mesh/patch_mesh.h"
#include "scene/scene.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {

/// Which objects carry how much of the light of all emissive surfaces.
class CarriedLight {
  public:
    CarriedLight(const Scene& scene, const PatchMesh& mesh) { update(scene, mesh); }
    /// Emission has changed.
    void update(const Scene& scene, const PatchMesh& mesh);

    /// How much of all direct light a move changes, relative, 0..1: the share of the emitted flux
    /// that goes along, times how far it goes in quarters of the scene's diameter. 0 where a sky or
    /// punctual lights, whose share is not known here, light the scene too.
    /// moved_bounds: two of every moved object, at its two places, m; diameter: of the scene, m.
    /// What is removed or comes back goes as far as it can.
    [[nodiscard]] float moved_share(std::span<const ObjectMove> moves,
                                    std::span<const Bounds> moved_bounds, float diameter);

  private:
    std::vector<double> flux_;  // by object, in one unknown unit; of removed ones, too
    std::vector<bool> there_;   // by object: it is not removed
    bool other_light_ = false;
};

}  // namespace raybundle
