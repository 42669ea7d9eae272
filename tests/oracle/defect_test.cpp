// SPDX-License-Identifier: Apache-2.0
// Defects of real models, numerics.md: within 2 % of the clean room, or of single rays where light
// is lost. All methods in ../heavy.
#include <gtest/gtest.h>

#include "defective_room.h"
#include "methods.h"
#include "scene/scene_report.h"

namespace raybundle::defect_test {
namespace {

std::string defect_name(const testing::TestParamInfo<Defect>& info) {
    return name_of(info.param);
}

OracleSettings usual() {
    OracleSettings settings;
    settings.iterations = 1536;
    return settings;
}

double floor_by(const Method& method, Defect defect) {
    const DefectiveRoom room(defect);
    return room.floor_mean(irradiance_by(method, room.scene, room.mesh, usual()));
}

double clean_floor() {
    static const double clean = floor_by(single_ray(), Defect::none);
    return clean;
}

class HarmlessDefect : public testing::TestWithParam<Defect> {};

TEST_P(HarmlessDefect, ChangesTheFloorByLessThanTwoPercent) {
    EXPECT_NEAR(floor_by(combined(), GetParam()) / clean_floor(), 1.0, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Defects, HarmlessDefect,
                         testing::Values(Defect::none, Defect::duplicate_faces,
                                         Defect::duplicate_object, Defect::t_junctions,
                                         Defect::gaps),
                         defect_name);

class HarmfulDefect : public testing::TestWithParam<Defect> {};

TEST_P(HarmfulDefect, IsWithinTwoPercentOfSingleRays) {
    const double rays = floor_by(single_ray(), GetParam());
    EXPECT_LT(rays, 0.95 * clean_floor()) << "the defect does nothing";
    EXPECT_NEAR(floor_by(combined(), GetParam()) / rays, 1.0, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Defects, HarmfulDefect,
                         testing::Values(Defect::flipped_wall, Defect::missing_wall), defect_name);

TEST(Defects, AreReported) {
    const auto report = [](Defect defect) {
        const DefectiveRoom room(defect);
        return make_scene_report(room.scene, room.mesh).edges.boundary;
    };
    const std::size_t clean = report(Defect::none);  // the floor and the lamp are objects
    EXPECT_GT(report(Defect::gaps), clean);
    EXPECT_GT(report(Defect::missing_wall), clean);
    EXPECT_GT(report(Defect::t_junctions), clean);
    EXPECT_EQ(DefectiveRoom(Defect::duplicate_faces).scene.removed.duplicate_faces, 2U);
    EXPECT_EQ(DefectiveRoom(Defect::slivers).scene.removed.degenerate_triangles, 1000U);
}

/// Triangles without area: reported, and the solution has the same bits.
TEST(Defects, SliversLeaveTheBitsAsTheyAre) {
    OracleSettings brief;
    brief.iterations = 64;
    const DefectiveRoom clean(Defect::none);
    const DefectiveRoom littered(Defect::slivers);
    for (const Method& method : {combined(), plane()}) {
        EXPECT_EQ(irradiance_by(method, littered.scene, littered.mesh, brief),
                  irradiance_by(method, clean.scene, clean.mesh, brief));
    }
}

}  // namespace
}  // namespace raybundle::defect_test
