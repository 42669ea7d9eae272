// SPDX-License-Identifier: Apache-2.0
#include "reference/solution_picture.h"

#include <gtest/gtest.h>

#include "research/reference_method.h"
#include "rooms.h"

namespace raybundle {
namespace {

/// Two triangles with a common edge, each with vertices of its own, then welded along the edge.
SceneBuilder square(bool welded) {
    SceneBuilder b;
    b.add_quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 1, 1, b.add_material(glm::vec3(0.5F)));
    if (welded) {
        b.mesh.triangles[1] = {0, 2, 5};  // (0,0,0), (1,0,1), (1,0,0)
    }
    return b;
}

TEST(InterpolatedIrradiance, IsTheMeanOverThePatchesOfAVertex) {
    const std::vector<glm::dvec3> patches = {glm::dvec3(1.0), glm::dvec3(3.0)};
    const SceneBuilder welded = square(true);
    const RayScene scene(welded.scene, welded.mesh);
    const InterpolatedIrradiance smooth(scene, patches);
    EXPECT_NEAR(smooth.at(scene.point_on_patch(0, {1.0, 0.0})).g, 1.0, 1e-12);
    EXPECT_NEAR(smooth.at(scene.point_on_patch(0, {0.0, 1.0})).g, 2.0, 1e-12);
    EXPECT_NEAR(smooth.at(scene.point_on_patch(0, {0.25, 0.5})).g, 1.75, 1e-12);
    EXPECT_NEAR(smooth.at(scene.point_on_patch(1, {0.0, 1.0})).g, 3.0, 1e-12);

    const SceneBuilder apart = square(false);
    const RayScene other(apart.scene, apart.mesh);
    const InterpolatedIrradiance flat(other, patches);
    EXPECT_NEAR(flat.at(other.point_on_patch(0, {0.0, 1.0})).g, 1.0, 1e-12);
    EXPECT_NEAR(flat.at(other.point_on_patch(1, {0.3, 0.3})).g, 3.0, 1e-12);
}

TEST(InterpolatedIrradiance, KeepsTheSidesOfADoubleSidedTriangleApart) {
    SceneBuilder b = square(true);
    for (std::uint32_t t = 0; t < 2; ++t) {
        b.mesh.back_side[t] = 2 + t;
        b.mesh.side_triangle.push_back(t);
        b.mesh.base_colour.emplace_back(0.5F);
        b.mesh.emission.emplace_back(0.0F);
    }
    const RayScene scene(b.scene, b.mesh);
    const InterpolatedIrradiance irradiance(
        scene, std::vector<glm::dvec3>{glm::dvec3(1.0), glm::dvec3(1.0), glm::dvec3(8.0),
                                       glm::dvec3(8.0)});
    EXPECT_NEAR(irradiance.at(scene.point_on_patch(1, {0.2, 0.2})).g, 1.0, 1e-12);
    EXPECT_NEAR(irradiance.at(scene.point_on_patch(3, {0.2, 0.2})).g, 8.0, 1e-12);
}

/// All three methods of the command line on one room: path and single ray agree on the picture's
/// mean, which is far from the noise of both; ray casting shows less.
TEST(ReferenceMethod, AllShowTheSameRoom) {
    const SceneBuilder room = enclosure(0.7F);
    const RayScene scene(room.scene, room.mesh);
    Camera camera;
    camera.eye = glm::vec3(odd_rotation() * glm::vec4(2.0F, 2.0F, 0.2F, 1.0F));
    camera.target = glm::vec3(odd_rotation() * glm::vec4(2.0F, 1.0F, 4.0F, 1.0F));
    camera.vertical_fov = 1.0F;
    const auto mean = [&](ReferenceKind kind, int iterations) {
        const auto method = make_reference_method(kind, scene, camera, {24, 24}, 1);
        for (int i = 0; i < iterations; ++i) {
            method->iterate();
        }
        EXPECT_EQ(method->iterations(), static_cast<std::uint64_t>(iterations));
        EXPECT_EQ(method->non_finite(), 0U);
        EXPECT_LT(method->error().relative, 0.05);
        double sum = 0.0;
        for (const glm::dvec3& pixel : method->picture()) {
            sum += pixel.g / (24.0 * 24.0);
        }
        return sum;
    };
    const double path = mean(ReferenceKind::path, 512);
    EXPECT_NEAR(mean(ReferenceKind::single_ray, 24), path, 0.01 * path);
    EXPECT_LT(mean(ReferenceKind::ray_cast, 512), 0.6 * path);
}

}  // namespace
}  // namespace raybundle
