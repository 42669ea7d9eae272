// SPDX-License-Identifier: Apache-2.0
#include "session/live_scene.h"

#include <utility>
#include <vector>

#include "scene/edit/surface_edit.h"

namespace raybundle {

LiveScene::LiveScene(Scene scene, PatchMesh mesh, const SolverSettings& settings, ChangeLog& log)
    : scene_(std::move(scene)),
      mesh_(std::move(mesh)),
      settings_(settings),
      log_(log),
      solver_(std::make_unique<Solver>(scene_, mesh_, settings)),
      programs_(std::make_unique<ViewPrograms>(solver_->scene())) {}

PatchMesh LiveScene::settled_mesh() const {
    PatchMesh mesh = mesh_;
    std::vector<std::uint32_t> materials;
    for (const std::uint32_t lamp : fades_.lamps()) {
        if (const std::uint32_t material = material_of_light(scene_, lamp);
            material != no_material) {
            materials.push_back(material);
        }
    }
    if (!materials.empty()) {
        refresh_surfaces(scene_, materials, mesh);
    }
    return mesh;
}

std::unique_ptr<ViewerImage> LiveScene::make_picture(glm::uvec2 size) const {
    const Solver& solver = *solver_;
    return std::make_unique<ViewerImage>(solver.scene(), solver.store(), *programs_, size);
}

float LiveScene::patch_illuminance(std::uint32_t side) const {
    const Solver& solver = *solver_;
    return luminance(solver.store().read_irradiance(mesh_.patch_of(side)));
}

void LiveScene::replace(std::unique_ptr<Solver> solver, std::unique_ptr<ViewPrograms> programs) {
    solver_ = std::move(solver);
    programs_ = std::move(programs);
}

}  // namespace raybundle
