// SPDX-License-Identifier: Apache-2.0
// Which luminaires light an area, and what their colour rendering comes to.
#include "measure/zone_luminaires.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lit_room.h"
#include "measure/requirement.h"
#include "rooms.h"

namespace raybundle {
namespace {

/// A box of 4 m x 3 m x 4 m with a white inside, from x0 on.
void add_room(SceneBuilder& builder, float x0, float albedo) {
    const std::uint32_t wall = builder.add_material(glm::vec3(albedo));
    const glm::vec3 o(x0, 0, 0);
    builder.add_quad(o, {0, 0, 4}, {4, 0, 0}, 4, 4, wall);
    builder.add_quad(o + glm::vec3(0, 3, 0), {4, 0, 0}, {0, 0, 4}, 4, 4, wall);
    builder.add_quad(o, {4, 0, 0}, {0, 3, 0}, 4, 3, wall);
    builder.add_quad(o + glm::vec3(0, 0, 4), {0, 3, 0}, {4, 0, 0}, 3, 4, wall);
    builder.add_quad(o, {0, 3, 0}, {0, 0, 4}, 3, 4, wall);
    builder.add_quad(o + glm::vec3(4, 0, 0), {0, 0, 4}, {0, 3, 0}, 4, 3, wall);
}

PunctualLight& add_lamp(SceneBuilder& builder, const glm::vec3& at, const glm::vec3& aim,
                        float candela, const char* name) {
    add_punctual_light(builder, glm::mat4(1.0F), PunctualKind::spot, at, aim, glm::vec3(candela));
    builder.scene.punctual_lights.back().name = name;
    return builder.scene.punctual_lights.back();
}

std::vector<CalculationPoint> grid(double x0, double height, int n) {
    std::vector<CalculationPoint> points;
    for (int i = 0; i < n * n; ++i) {
        points.push_back({{x0 + 4.0 * (i % n + 0.5) / n, height, 4.0 * (i / n + 0.5) / n}, {}});
    }
    return points;
}

std::vector<ZoneLuminaire> found_in(const SceneBuilder& builder, double x0, bool direct = false) {
    const MeasuredScene scene(builder.scene, builder.mesh);
    return find_zone_luminaires(scene, grid(x0, 0.75, 8), Quantity::horizontal, direct);
}

/// Rounding does not decide whether the floor hides lamps from points on it, or just below.
TEST(ZoneLuminaires, AreFoundFromTheFloorToo) {
    SceneBuilder builder;
    add_room(builder, 0.1F, 0.7F);
    for (int i = 0; i < 9; ++i) {
        add_lamp(builder,
                 {0.8F + 1.3F * static_cast<float>(i % 3), 2.8F,
                  0.7F + 1.3F * static_cast<float>(i / 3)},
                 {0, -1, 0}, 1000.0F, "downlight");
    }
    const MeasuredScene scene(builder.scene, builder.mesh);
    for (const double height : {0.0, -5e-4}) {
        EXPECT_EQ(
            find_zone_luminaires(scene, grid(0.1, height, 8), Quantity::horizontal, true).size(),
            9U)
            << height;
    }
}

TEST(ZoneLuminaires, AreThoseOfTheRoomByWhateverWay) {
    SceneBuilder builder;
    add_room(builder, 0.0F, 0.7F);
    add_room(builder, 5.0F, 0.7F);
    add_lamp(builder, {2, 2.8F, 2}, {0, -1, 0}, 1000.0F, "downlight");
    add_lamp(builder, {1, 2.0F, 1}, {0, 1, 0}, 1000.0F, "uplight");
    add_lamp(builder, {7, 2.8F, 2}, {0, -1, 0}, 1000.0F, "next door");
    add_lamp(builder, {3, 2.8F, 3}, {0, -1, 0}, 1000.0F, "off").intensity = glm::vec3(0.0F);
    const auto found = found_in(builder, 0.0);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].name, "downlight");
    EXPECT_EQ(found[0].light, 1U);
    EXPECT_EQ(found[1].name, "uplight");
    EXPECT_NEAR(found[0].share + found[1].share, 1.0, 1e-9);
    EXPECT_GT(found[1].share, 0.1);
    const auto direct = found_in(builder, 0.0, true);
    ASSERT_EQ(direct.size(), 1U);
    EXPECT_EQ(direct[0].name, "downlight");
    ASSERT_EQ(found_in(builder, 5.0).size(), 1U);
    EXPECT_EQ(found_in(builder, 5.0)[0].name, "next door");
}

/// Where nothing reflects, shares are those of I cos^4/h² at the middle: a lamp of a third of the
/// other's intensity at the same place has a quarter of the light.
TEST(ZoneLuminaires, HaveTheirShareOfTheLight) {
    SceneBuilder builder;
    add_room(builder, 0.0F, 0.0F);
    add_lamp(builder, {2, 2.8F, 2}, {0, -1, 0}, 300.0F, "weak");
    add_lamp(builder, {2, 2.8F, 2}, {0, -1, 0}, 900.0F, "strong");
    const std::uint32_t panel = builder.add_material(glm::vec3(0.0F), glm::vec3(0.001F));
    builder.add_quad({1, 2.9F, 1}, {1, 0, 0}, {0, 0, 1}, 1, 1, panel);
    const auto found = found_in(builder, 0.0);
    ASSERT_EQ(found.size(), 2U);  // the panel brings less than 2 %
    EXPECT_EQ(found[0].name, "strong");
    EXPECT_NEAR(found[0].share, 0.75, 1e-3);
    EXPECT_NEAR(found[1].share, 0.25, 1e-3);
}

/// Of a field of equal luminaires none is forgotten, however small its share.
TEST(ZoneLuminaires, AreAllOfALargeField) {
    SceneBuilder builder;
    add_room(builder, 0.0F, 0.5F);
    for (int i = 0; i < 100; ++i) {
        add_lamp(builder,
                 {0.2F + 0.4F * static_cast<float>(i % 10), 2.9F,
                  0.2F + 0.4F * static_cast<float>(i / 10)},
                 {0, -1, 0}, 100.0F, "panel");
    }
    EXPECT_GT(found_in(builder, 0.0).size(), 90U);
}

/// A luminaire that has been added has its number on the wire, and not its place in the list.
TEST(ZoneLuminaires, HaveTheNumbersOfTheWire) {
    SceneBuilder builder;
    add_room(builder, 0.0F, 0.5F);
    AddedLuminaire added;
    added.number = 1'000'007;
    add_lamp(builder, {2, 2.8F, 2}, {0, -1, 0}, 10.0F, "added").added =
        std::make_shared<const AddedLuminaire>(added);
    add_lamp(builder, {2, 2.8F, 2}, {0, -1, 0}, 5.0F, "of the file");
    const auto found = found_in(builder, 0.0);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].light, 1'000'007U);
    EXPECT_EQ(found[1].light, 1U);
}

ZoneLuminaire lamp_with(const char* name, std::optional<ColourRendering> known) {
    return {1, name, 0.5, known};
}

Check ra(std::vector<ZoneLuminaire> luminaires, double least = 80.0) {
    Requirement requirement;
    requirement.colour_rendering = least;
    const std::vector<Check> checks =
        check(requirement, Quantity::horizontal, MeasurementSummary{}, {}, luminaires);
    EXPECT_EQ(checks.size(), 1U);
    EXPECT_EQ(checks[0].what, "Ra");
    EXPECT_FALSE(checks[0].by_measurement);
    return checks[0];
}

TEST(ColourRenderingRequirement, IsMetWhereEachLuminaireStatesEnough) {
    const ColourRendering group_1b{80.0F, 89.0F};
    const ColourRendering ninety{90.0F, 90.0F};
    const ColourRendering seventy{70.0F, 70.0F};
    EXPECT_EQ(ra({lamp_with("a", group_1b), lamp_with("b", ninety)}).verdict, Verdict::met);
    const Check vague = ra({lamp_with("a", group_1b)}, 85.0);
    EXPECT_EQ(vague.verdict, Verdict::unknown);
    EXPECT_EQ(vague.words, "a has Ra 80 to 89");
    const Check silent =
        ra({lamp_with("a", ninety), lamp_with("desk 3", {}), lamp_with("desk 3", {})});
    EXPECT_EQ(silent.verdict, Verdict::unknown);
    EXPECT_EQ(silent.words, "not stated by desk 3 (2 of them)");
    const Check missed = ra({lamp_with("tube", seventy), lamp_with("b", {})});
    EXPECT_EQ(missed.verdict, Verdict::missed);
    EXPECT_EQ(missed.words, "tube has Ra 70; not stated by b");
    const Check dark = ra({});
    EXPECT_EQ(dark.verdict, Verdict::unknown);
    EXPECT_EQ(dark.words, "no luminaire lights it");
    // Nothing is asked of glare, nor said of it.
    Requirement requirement;
    requirement.colour_rendering = 80.0;
    EXPECT_TRUE(check(requirement, Quantity::ugr, std::nullopt, {}).empty());
}

}  // namespace
}  // namespace raybundle
