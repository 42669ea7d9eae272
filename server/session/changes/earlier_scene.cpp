// SPDX-License-Identifier: Apache-2.0
#include "session/changes/earlier_scene.h"

#include <numeric>
#include <utility>
#include <vector>

#include "session/messages/scene_messages.h"

namespace raybundle {

namespace {

Scene as_it_was(Scene scene, std::span<const v1::SceneChanged> changes) {
    for (const v1::SceneChanged& change : changes) {
        apply(scene, change);
    }
    return scene;
}

/// Patches with the colours that the scene's materials have.
PatchMesh coloured(PatchMesh mesh, const Scene& scene) {
    std::vector<std::uint32_t> materials(scene.materials.size());
    std::iota(materials.begin(), materials.end(), 0U);
    refresh_surfaces(scene, materials, mesh);
    return mesh;
}

}  // namespace

EarlierScene::EarlierScene(std::uint32_t epoch, const Scene& scene, const PatchMesh& mesh,
                           std::span<const v1::SceneChanged> changes,
                           const SolverSettings& settings)
    : epoch_(epoch),
      scene_(as_it_was(scene, changes)),
      mesh_(coloured(mesh, scene_)),
      solver_(scene_, mesh_, settings),
      programs_(solver_.scene()) {}

void EarlierScene::step(ViewerImage& picture) {
    BundleReceiver* const receivers[] = {&picture};
    solver_.step(receivers);
}

}  // namespace raybundle
