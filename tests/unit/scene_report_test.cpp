// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_report.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "gltf_builder.h"
#include "scene/significant.h"

namespace raybundle::test {
namespace {

Bounds cube(float size) {
    Bounds bounds;
    bounds.add(glm::vec3(0));
    bounds.add(glm::vec3(size));
    return bounds;
}

TEST(SceneReport, NumbersOfLightHaveNoExponent) {
    EXPECT_EQ(significant(24998.0, 4), "25000");
    EXPECT_EQ(significant(9999.6, 4), "10000");
    EXPECT_EQ(significant(-123456.0, 4), "-123500");
    EXPECT_EQ(significant(123.456, 4), "123.5");
    EXPECT_EQ(significant(117.0, 2), "120");
    EXPECT_EQ(significant(0.0, 4), "0");
    EXPECT_EQ(significant(0.00123, 2), "0.0012");
    EXPECT_EQ(significant(1.5e-7, 2), "1.5e-07");
    EXPECT_EQ(significant(2e20, 4), "2e+20");
    EXPECT_EQ(significant(std::numeric_limits<double>::infinity(), 4), "inf");
}

TEST(SceneReport, HintsAtWrongUnits) {
    EXPECT_FALSE(unit_hint(cube(5.0F)));
    EXPECT_FALSE(unit_hint(cube(99.0F)));
    const auto box = [](const glm::vec3& size) { return Bounds{glm::vec3(0.0F), size}; };
    EXPECT_FALSE(unit_hint(box({999.0F, 60.0F, 999.0F}))) << "a site";
    EXPECT_NE(unit_hint(cube(1600.0F))->find("--unit"), std::string::npos);
    EXPECT_EQ(unit_hint(box({12'240.0F, 3200.0F, 9240.0F}))->find("the scene is 12240 m large"),
              0U);
    EXPECT_NE(unit_hint(cube(9000.0F))->find("--unit cm"), std::string::npos);
    EXPECT_NE(unit_hint(cube(90'000.0F))->find("--unit mm"), std::string::npos);
    EXPECT_NE(unit_hint(cube(9e6F))->find("--unit mm"), std::string::npos);
    // A room of 6.5 x 10 m in millimetres, or a hall of 65 x 100 m in centimetres: both are named.
    const std::string room = unit_hint(box({6483.0F, 2197.0F, 9995.0F})).value_or("");
    EXPECT_NE(room.find("--unit mm (9.995 m)"), std::string::npos) << room;
    EXPECT_NE(room.find("--unit cm (99.95 m)"), std::string::npos) << room;
    EXPECT_NE(unit_hint(box({556.0F, 549.0F, 559.0F}))->find("--unit cm"), std::string::npos)
        << "549 m high";
    EXPECT_NE(unit_hint(cube(0.005F))->find("--unit m"), std::string::npos);
}

TEST(SceneReport, CountsIrregularEdges) {
    GltfBuilder closed;
    closed.add_node({{"mesh", closed.add_box_mesh({0, 0, 0}, {1, 1, 1})}});
    const EdgeDefects none = count_edge_defects(closed.load());
    EXPECT_EQ(none.boundary, 0U);
    EXPECT_EQ(none.non_manifold, 0U);

    GltfBuilder fins;
    // Three triangles at one edge.
    fins.add_node({{"mesh", fins.add_triangle_mesh({{0, 0, 0},
                                                    {0, 1, 0},
                                                    {1, 0, 0},
                                                    {0, 0, 0},
                                                    {0, 1, 0},
                                                    {-1, 0, 0},
                                                    {0, 0, 0},
                                                    {0, 1, 0},
                                                    {0, 0, 1}})}});
    const EdgeDefects defects = count_edge_defects(fins.load());
    EXPECT_EQ(defects.boundary, 6U);
    EXPECT_EQ(defects.non_manifold, 1U);
}

TEST(SceneReport, PrintsAndGivesJson) {
    GltfBuilder builder;
    builder.add_node({{"mesh", builder.add_box_mesh({0, 0, 0}, {1, 1, 1})}, {"name", "crate"}});
    Scene scene = builder.load();
    TessellationSettings settings;
    settings.target_patches = 500;
    const PatchMesh mesh = tessellate(scene, settings);
    const SceneReport report = make_scene_report(scene, mesh);
    EXPECT_NEAR(report.area, 6.0, 1e-5);
    EXPECT_EQ(report.patches, mesh.patch_count());
    std::ostringstream text;
    print_scene_report(text, scene, report);
    EXPECT_NE(text.str().find("crate"), std::string::npos);
    const Json json = scene_report_json(scene, report);
    EXPECT_EQ(json.at("triangles"), 12);
    EXPECT_EQ(json.at("objects").at(0).at("name"), "crate");
    EXPECT_EQ(json.at("boundaryEdges"), 0);
    EXPECT_FALSE(json.contains("unitHint"));
}

}  // namespace
}  // namespace raybundle::test
