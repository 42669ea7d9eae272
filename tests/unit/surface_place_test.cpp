// SPDX-License-Identifier: Apache-2.0
// Points of surfaces are found again, however the surface is cut.
#include "scene/mesh/surface_place.h"

#include <gtest/gtest.h>

#include "gltf_builder.h"
#include "scene/mesh/mesh_growth.h"

namespace raybundle::test {
namespace {

/// A folded sheet, both of whose sides are patches: one half lies, the other stands on its edge.
GltfBuilder folded_sheet() {
    GltfBuilder builder;
    const int material = builder.add_material({{"doubleSided", true}});
    const int positions =
        builder.add_positions({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}});
    const int indices = builder.add_indices({0, 1, 2, 0, 2, 3, 3, 2, 5, 3, 5, 4});
    builder.add_node({{"mesh", builder.add_mesh({{"attributes", {{"POSITION", positions}}},
                                                 {"indices", indices},
                                                 {"material", material}})}});
    return builder;
}

PatchMesh cut(Scene& scene, float size) {
    TessellationSettings settings;
    settings.patch_size = size;
    return tessellate(scene, settings);
}

glm::vec3 centre(const PatchMesh& mesh, std::uint32_t side) {
    const glm::uvec3& t = mesh.triangles[mesh.side_triangle[side]];
    return (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0F;
}

TEST(SurfacePlace, OfEverySideLeadsBackToIt) {
    Scene scene = folded_sheet().load();
    const PatchMesh mesh = cut(scene, 0.4F);
    ASSERT_EQ(mesh.side_count(), 2 * mesh.triangle_count());
    for (std::uint32_t side = 0; side < mesh.side_count(); ++side) {
        EXPECT_EQ(side_at(mesh, surface_place(mesh, side, centre(mesh, side))), side);
    }
}

TEST(SurfacePlace, KeepsItsSideWhenObjectsComeBehind) {
    Scene scene = folded_sheet().load();
    PatchMesh mesh = cut(scene, 0.4F);
    const PatchMesh before = mesh;
    AddedObject twin;
    twin.copy_of = 1;
    add_object(scene, mesh, twin);
    for (std::uint32_t side = 0; side < before.side_count(); ++side) {
        const auto now = side_at(mesh, surface_place(before, side, centre(before, side)));
        const std::uint32_t triangle = before.side_triangle[side];
        EXPECT_EQ(now, side < before.triangle_count() ? triangle : mesh.back_side[triangle]);
    }
}

TEST(SurfacePlace, IsOnTheSameSideOfASurfaceThatIsCutOtherwise) {
    Scene scene = folded_sheet().load();
    const PatchMesh coarse = cut(scene, 2.0F);
    const PatchMesh fine = cut(scene, 0.3F);
    for (std::uint32_t side = 0; side < fine.side_count(); ++side) {
        const SurfacePlace point = surface_place(fine, side, centre(fine, side));
        const auto found = side_at(coarse, point);
        ASSERT_TRUE(found);
        const SurfacePlace there = surface_place(coarse, *found, point.position);
        EXPECT_LT(glm::distance(there.position, point.position), 1e-6F);
        EXPECT_GT(glm::dot(there.normal, point.normal), 0.999F) << "neither behind nor beside it";
    }
}

TEST(SurfacePlace, AtTheFoldBelongsToTheHalfThatItsNormalSays) {
    Scene scene = folded_sheet().load();
    const PatchMesh mesh = cut(scene, 2.0F);
    const glm::vec3 fold(1.0F, 0.0F, 0.25F);
    for (std::uint32_t side = 0; side < mesh.side_count(); ++side) {
        const SurfacePlace point = surface_place(mesh, side, fold);
        if (point.position != fold) {
            continue;  // of the half that has no edge there
        }
        const SurfacePlace again = surface_place(mesh, *side_at(mesh, point), fold);
        EXPECT_EQ(again.normal, point.normal);
    }
}

TEST(SurfacePlace, OfAnObjectThatIsNotThereIsOnNoSide) {
    Scene scene = folded_sheet().load();
    EXPECT_FALSE(side_at(cut(scene, 2.0F), {7, glm::vec3(0.0F), glm::vec3(0, 1, 0)}));
}

}  // namespace
}  // namespace raybundle::test
