// SPDX-License-Identifier: Apache-2.0
// Lights that are placed, turned, shaped, coloured by temperature and grouped while a scene is
// shown.
#include "scene/edit/light_edit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/light/colour_temperature.h"
#include "scene/light/light_place.h"

namespace raybundle::test {
namespace {

using std::numbers::pi;

PunctualLight lamp(PunctualKind kind) {
    PunctualLight light;
    light.name = "lamp";
    light.kind = kind;
    light.intensity = glm::vec3(100.0F);
    light.inner_cosine = std::cos(0.2F);
    light.outer_cosine = std::cos(0.5F);
    light.position = {1, 2, 3};
    return light;
}

Scene scene_with(const PunctualLight& light) {
    Scene scene;
    scene.bounds.add(glm::vec3(-5.0F));
    scene.bounds.add(glm::vec3(5.0F));
    scene.punctual_lights.push_back(light);
    return scene;
}

std::string problem(const PunctualLight& light, LightEdit edit) {
    edit.light = 1;
    return problem_of(scene_with(light), edit);
}

void expect_same_axes(const glm::mat3& a, const glm::mat3& b, const char* what) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(glm::length(a[i] - b[i]), 0.0F, 2e-6F) << what << ", axis " << i;
    }
}

TEST(LightPlace, IsWhatItWasSetTo) {
    for (const glm::vec3 aim : {glm::vec3(0, -1, 0), glm::vec3(0, 1, 0), glm::vec3(1, 0, 0),
                                glm::vec3(-0.3F, -0.9F, 0.2F), glm::vec3(1e-4F, -1, -2e-4F)}) {
        for (const float rotation : {0.0F, 30.0F, -90.0F, 179.0F}) {
            for (const float hand : {1.0F, -1.0F}) {
                PunctualLight light = lamp(PunctualKind::spot);
                light.axes[1] *= hand;
                set_place({{4, 5, 6}, glm::normalize(aim), rotation}, light);
                EXPECT_EQ(glm::determinant(light.axes) < 0.0F, hand < 0.0F);
                const LightPlace place = place_of(light);
                EXPECT_EQ(place.position, glm::vec3(4, 5, 6));
                EXPECT_NEAR(glm::length(place.aim - glm::normalize(aim)), 0.0F, 1e-6F);
                EXPECT_NEAR(place.rotation, rotation, 1e-3F);
                PunctualLight again = light;
                set_place(place, again);
                expect_same_axes(again.axes, light.axes, "set again");
            }
        }
    }
}

/// Aimed down, C0 lies along +x, and C90 to the left of it as seen by who looks up at the lamp.
TEST(LightPlace, PlaneC0LiesAlongXOfWhatIsAimedDown) {
    PunctualLight light = lamp(PunctualKind::point);
    set_place({{}, {0, -1, 0}, 0.0F}, light);
    expect_same_axes(light.axes, glm::mat3({1, 0, 0}, {0, 0, -1}, {0, 1, 0}), "down");
    // A right-handed turn about straight down brings +x to +z.
    set_place({{}, {0, -1, 0}, 90.0F}, light);
    expect_same_axes(light.axes, glm::mat3({0, 0, 1}, {1, 0, 0}, {0, 1, 0}), "turned");
    // The shortest way from down to +x turns C0 from +x to straight up.
    set_place({{}, {1, 0, 0}, 0.0F}, light);
    EXPECT_NEAR(glm::length(light.axes[0] - glm::vec3(0, 1, 0)), 0.0F, 1e-6F);
}

TEST(LightEdit, PlacesAndShapesWhatItNames) {
    Scene scene = scene_with(lamp(PunctualKind::spot));
    LightEdit edit;
    edit.light = 1;
    edit.aim = glm::vec3(3, 0, 0);
    edit.outer_cone = 40.0F;
    apply(scene, edit);
    const PunctualLight& light = scene.punctual_lights[0];
    EXPECT_EQ(light.position, glm::vec3(1, 2, 3));
    EXPECT_NEAR(glm::length(light.axes[2] + glm::vec3(1, 0, 0)), 0.0F, 1e-6F);
    EXPECT_NEAR(light.outer_cosine, std::cos(glm::radians(40.0F)), 1e-6F);
    EXPECT_EQ(light.inner_cosine, std::cos(0.2F));
    edit = {};
    edit.light = 1;
    edit.inner_cone = 40.0F;  // a hard edge
    apply(scene, edit);
    EXPECT_GT(light.inner_cosine, light.outer_cosine);
}

/// As an undo does, whose state names everything: what stays keeps its bits.
TEST(LightEdit, SetToWhatItIsStaysAsItIs) {
    for (const glm::vec3 aim : {glm::vec3(0.3F, -0.8F, 0.5F), glm::vec3(0, -1, 1e-7F)}) {
        PunctualLight light = lamp(PunctualKind::spot);
        set_place({{0.1F, 2.3F, -0.7F}, glm::normalize(aim), 37.0F}, light);
        Scene scene = scene_with(light);
        const LightPlace place = place_of(light);
        LightEdit edit;
        edit.light = 1;
        edit.position = place.position;
        edit.aim = place.aim;
        edit.rotation = place.rotation;
        edit.inner_cone = glm::degrees(std::acos(light.inner_cosine));
        edit.outer_cone = glm::degrees(std::acos(light.outer_cosine));
        apply(scene, edit);
        const PunctualLight& same = scene.punctual_lights[0];
        EXPECT_EQ(same.axes, light.axes);
        EXPECT_EQ(same.position, light.position);
        EXPECT_EQ(same.inner_cosine, light.inner_cosine);
        EXPECT_EQ(same.outer_cosine, light.outer_cosine);
    }
}

TEST(LightEdit, DimsWithoutForgettingTheFullLight) {
    Scene scene = scene_with(lamp(PunctualKind::point));
    const auto intensity_after = [&scene](std::optional<float> dim, std::optional<bool> on,
                                          std::optional<float> intensity) {
        LightEdit edit;
        edit.light = 1;
        edit.dim = dim;
        edit.on = on;
        edit.intensity = intensity;
        apply(scene, edit);
        return luminance(scene.punctual_lights[0].intensity);
    };
    EXPECT_NEAR(intensity_after(0.4F, {}, {}), 40.0F, 1e-4F);
    EXPECT_EQ(intensity_after({}, false, {}), 0.0F);
    EXPECT_EQ(intensity_after({}, {}, 200.0F), 0.0F);
    EXPECT_NEAR(intensity_after({}, true, {}), 80.0F, 1e-4F);
    EXPECT_NEAR(intensity_after(1.0F, {}, {}), 200.0F, 1e-3F);
}

TEST(LightEdit, RefusesWhatHasNoPlace) {
    LightEdit move;
    move.position = glm::vec3(0.0F);
    LightEdit cone;
    cone.outer_cone = 30.0F;
    EXPECT_EQ(problem(lamp(PunctualKind::point), move), "");
    EXPECT_EQ(problem(lamp(PunctualKind::point), cone), "only spots have cones");
    EXPECT_EQ(problem(lamp(PunctualKind::spot), cone), "");
    EXPECT_EQ(problem(lamp(PunctualKind::directional), move),
              "a directional light has an aim, but no position");
    PunctualLight sun = lamp(PunctualKind::directional);
    sun.of_sky = true;
    LightEdit aim;
    aim.aim = glm::vec3(1, 0, 0);
    EXPECT_EQ(problem(sun, aim), "the sky has the place of its suns");
    move.position = glm::vec3(0.0F, 1e7F, 0.0F);
    EXPECT_EQ(problem(lamp(PunctualKind::point), move),
              "its position may be 167772 m away from zero at most");
    Scene carried = scene_with(lamp(PunctualKind::point));
    carried.objects.resize(1);
    carried.objects[0].id = 1;
    carried.objects[0].name = "pendant";
    carried.punctual_lights[0].object = 0;
    aim.light = 1;
    EXPECT_EQ(problem_of(carried, aim), "light 1 is carried by object 1 ('pendant'): move that");
}

TEST(LightEdit, KnowsTheFluxOfAnIntensity) {
    EXPECT_NEAR(flux_per_intensity(scene_with(lamp(PunctualKind::point)), 1), 4.0 * pi, 1e-4);
    EXPECT_EQ(flux_per_intensity(scene_with(lamp(PunctualKind::directional)), 1), 0.0);
    // Luminaires are known by their flux.
    PunctualLight luminaire = lamp(PunctualKind::point);
    luminaire.profile = std::make_shared<const IesProfile>(
        parse_photometry("f", "TILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 1\n0 180\n0\n50 50\n"));
    EXPECT_NEAR(flux_per_intensity(scene_with(luminaire), 1), 1.0, 1e-6);
    Scene area;
    area.lights.resize(1);
    area.lights[0].area = 2.0;
    EXPECT_NEAR(flux_per_intensity(area, 1), 2.0 * pi, 1e-12);
}

glm::dvec2 chromaticity(const glm::vec3& rgb) {
    // Rec. 709 to XYZ, IEC 61966-2-1.
    const glm::dvec3 c(rgb);
    const glm::dvec3 xyz(0.4124 * c.r + 0.3576 * c.g + 0.1805 * c.b,
                         0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b,
                         0.0193 * c.r + 0.1192 * c.g + 0.9505 * c.b);
    return glm::dvec2(xyz) / (xyz.x + xyz.y + xyz.z);
}

/// Against published chromaticities: CIE illuminants A (2856 K), D50, D65 and D75, and black
/// bodies.
TEST(ColourTemperature, HasThePublishedChromaticities) {
    struct Published {
        double kelvin, x, y;
    };
    for (const Published& p :
         {Published{2856.0, 0.44758, 0.40745}, Published{3000.0, 0.43693, 0.40407},
          Published{4000.0, 0.38045, 0.37675}, Published{5003.0, 0.34567, 0.35850},
          Published{6504.0, 0.31272, 0.32903}, Published{7504.0, 0.29902, 0.31485}}) {
        const glm::dvec2 xy = chromaticity(colour_of_temperature(p.kelvin));
        EXPECT_NEAR(xy.x, p.x, 2e-3) << p.kelvin << " K";
        EXPECT_NEAR(xy.y, p.y, 2e-3) << p.kelvin << " K";
    }
    for (double kelvin = min_colour_temperature; kelvin <= max_colour_temperature;
         kelvin += 500.0) {
        const glm::vec3 colour = colour_of_temperature(kelvin);
        EXPECT_NEAR(luminance(colour), 1.0F, 1e-5F);
        EXPECT_TRUE(glm::all(glm::greaterThanEqual(colour, glm::vec3(0.0F))));
    }
}

}  // namespace
}  // namespace raybundle::test
