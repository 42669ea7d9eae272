// SPDX-License-Identifier: Apache-2.0
#include "changed_room.h"

#include <gtest/gtest.h>

namespace raybundle {

namespace {

SolverSettings quick(std::uint64_t seed) {
    SolverSettings settings;
    settings.seed = seed;
    settings.coarse = {96, 150};
    settings.coarse_iterations = 1'000'000;
    return settings;
}

Camera into_the_room() {
    Camera camera;
    camera.eye = {3.0F, 1.5F, 0.2F};
    camera.target = {2.5F, 1.0F, 4.0F};
    camera.vertical_fov = 1.3F;
    return camera;
}

}  // namespace

Solved::Solved(SceneBuilder scene, std::uint64_t seed)
    : b(std::move(scene)),
      solver(b.scene, b.mesh, quick(seed)),
      programs(solver.scene()),
      image(solver.scene(), solver.store(), programs, {40, 30}) {
    image.set_camera(into_the_room());
}

void Solved::iterate(std::uint64_t count) {
    BundleReceiver* const receivers[] = {&image};
    for (const std::uint64_t end = solver.iterations() + count; solver.iterations() < end;) {
        solver.step(receivers);
    }
}

void Solved::change(const LightEdit& edit) {
    BundleReceiver* const receivers[] = {&image};
    ASSERT_EQ(problem_of(b.scene, edit), "");
    const std::uint32_t material = apply(b.scene, edit);
    ASSERT_EQ(material, no_material);
    solver.change_surfaces(b.scene, b.mesh, {}, {}, receivers);
    while (solver.correcting()) {
        solver.step(receivers);
    }
}

void expect_fresh(Solved& changed, std::uint64_t iterations, const char* what,
                  const LevelBounds& bounds) {
    Solved fresh(changed.b, 77);
    fresh.iterate(iterations);
    const auto [level, difference] =
        compared(changed.solver.store().read_irradiance(), fresh.solver.store().read_irradiance());
    EXPECT_NEAR(level, 1.0, bounds.solution) << what;
    EXPECT_LT(difference, 0.05) << what;
    const auto [shown, apart] =
        compared(changed.image.read_radiance(), fresh.image.read_radiance());
    EXPECT_NEAR(shown, 1.0, bounds.picture) << what;
    EXPECT_LT(apart, 0.08) << what;
}

}  // namespace raybundle
