// SPDX-License-Identifier: Apache-2.0
#include "solution/geometry/patch_cells.h"

#include <gtest/gtest.h>

#include <numeric>

#include "oracle/scene_builder.h"

namespace raybundle::patch_cells_test {
namespace {

constexpr std::uint64_t never = 1'000'000'000;

double sum_of(const std::vector<glm::vec3>& flux) {
    return std::accumulate(flux.begin(), flux.end(), 0.0, [](double sum, const glm::vec3& value) {
        return sum + static_cast<double>(value.g);
    });
}

/// A floor and a lid of the same object, and a table of another one just above the floor.
SceneBuilder floor_lid_and_table() {
    SceneBuilder b;
    const auto material = b.add_material(glm::vec3(0.5F));
    b.add_quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 16, 16, material);
    b.add_quad({0, 0.01F, 0}, {1, 0, 0}, {0, 0, 1}, 16, 16, material);
    b.add_object("table");
    b.add_quad({0, 0.02F, 0}, {0, 0, 1}, {1, 0, 0}, 16, 16, material);
    return b;
}

TEST(PatchCells, KeepTheFluxHoweverTheyAreDivided) {
    const SceneBuilder b = floor_lid_and_table();
    const PatchCells cells(b.mesh);
    std::vector<glm::dvec3> flux;
    std::vector<std::uint32_t> met;
    for (std::size_t i = 0; i < b.mesh.patch_count(); ++i) {
        met.push_back(static_cast<std::uint32_t>(i * i % 7));
        flux.emplace_back(static_cast<double>(i % 11) - 3.0);
    }
    const double all =
        std::accumulate(flux.begin(), flux.end(), 0.0,
                        [](double sum, const glm::dvec3& value) { return sum + value.g; });
    for (const std::uint64_t least :
         {std::uint64_t{1}, std::uint64_t{30}, std::uint64_t{300}, never}) {
        EXPECT_NEAR(sum_of(cells.spread(flux, met, least)), all, 1e-3 * all) << least;
    }
}

TEST(PatchCells, AreDividedDownToPatchesWhereRaysAreMany) {
    const SceneBuilder b = floor_lid_and_table();
    const PatchCells cells(b.mesh);
    std::vector<glm::dvec3> flux(b.mesh.patch_count(), glm::dvec3(0.0));
    flux[5] = glm::dvec3(2.0);
    const std::vector<std::uint32_t> met(flux.size(), 100);
    const std::vector<glm::vec3> spread = cells.spread(flux, met, 1);
    for (std::size_t i = 0; i < spread.size(); ++i) {
        EXPECT_FLOAT_EQ(spread[i].g, i == 5 ? 2.0F : 0.0F) << i;
    }
}

/// Nor does light go through walls: what faces away, or belongs to another object, gets none.
TEST(PatchCells, HoldOneObjectsPatchesThatFaceOneWay) {
    const SceneBuilder b = floor_lid_and_table();
    const PatchCells cells(b.mesh);
    constexpr std::size_t floor_patches = 2 * 16 * 16;
    std::vector<glm::dvec3> flux(b.mesh.patch_count(), glm::dvec3(0.0));
    flux[5] = glm::dvec3(2.0);
    const std::vector<std::uint32_t> met(flux.size(), 1);
    const std::vector<glm::vec3> spread = cells.spread(flux, met, never);
    std::size_t reached = 0;
    for (std::size_t i = 0; i < spread.size(); ++i) {
        reached += spread[i].g > 0.0F ? 1 : 0;
        EXPECT_TRUE(i < floor_patches || spread[i].g == 0.0F) << i;
    }
    EXPECT_GT(reached, floor_patches / 4);
}

}  // namespace
}  // namespace raybundle::patch_cells_test
