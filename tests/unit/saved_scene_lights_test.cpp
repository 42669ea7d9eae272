// SPDX-License-Identifier: Apache-2.0
// Lights that have been edited, saved and loaded again are the same lights.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "saved_scene_room.h"
#include "scene/edit/daylight_edit.h"
#include "scene/edit/luminaire_edit.h"
#include "scene/edit/surface_edit.h"
#include "scene/light/environment.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle::test {
namespace {

TEST_F(SavedScene, LightsAreSetDimmedGroupedAndPlaced) {
    Scene scene = open();
    LightEdit lamp = edit_of(scene, "table lamp");
    lamp.intensity = 77.7F;
    lamp.colour = glm::vec3(0.2F, 0.5F, 0.9F);
    lamp.dim = 0.3F;
    lamp.group = "tables";
    lamp.maintenance_factor = 0.67F;
    lamp.colour_rendering = 83.0F;
    apply(scene, lamp);
    LightEdit spot = edit_of(scene, "spot");
    spot.position = glm::vec3(0.3F, 2.1F, -0.7F);
    spot.aim = glm::vec3(0.3F, -0.8F, 0.1F);
    spot.rotation = 33.0F;
    spot.inner_cone = 11.0F;
    spot.outer_cone = 27.0F;
    spot.on = false;
    ASSERT_EQ(problem_of(scene, spot), "");
    apply(scene, spot);
    LightEdit panel = edit_of(scene, "panel");
    panel.intensity = 333.3F;
    panel.dim = 0.45F;
    panel.group = "ceiling";
    apply(scene, panel);
    expect_same(scene);
    panel.on = false;
    apply(scene, panel);
    const Scene dark = expect_same(scene);
    EXPECT_EQ(dark.materials[2].emission, glm::vec3(0.0F));
}

TEST_F(SavedScene, LightsOfAMovedSurfaceStayWithIt) {
    Scene scene = open();
    object(scene, "panel").transform = odd_place(0.5F);
    LightEdit panel = edit_of(scene, "panel");
    panel.dim = 0.0F;
    apply(scene, panel);
    expect_same(scene);
}

TEST_F(SavedScene, LuminairesTakeTheirPhotometryAlong) {
    Scene scene = open();
    for (std::uint32_t i = 0; i < 3; ++i) {
        AddedLuminaire added;
        added.number = next_luminaire(scene);
        added.name = "desk " + std::to_string(i);
        added.photometry = "panel.ies";
        added.position = {0.3F * static_cast<float>(i), 2.0F, 0.1F};
        added.aim = {0.1F, -1.0F, 0.2F};
        added.rotation = 40.0F;
        added.group = "desks";
        ASSERT_EQ(problem_of(scene, added), "");
        add_luminaire(scene, added);
    }
    set_light_removed(scene, first_added_light + 1, true);
    LightEdit exchanged = edit_of(scene, "spot");
    exchanged.photometry = "panel.ies";
    exchanged.intensity = 1234.0F;
    ASSERT_EQ(problem_of(scene, exchanged), "");
    apply(scene, exchanged);
    SavedLightingScene lighting{"evening", "Ada", {}};
    lighting.lamps.push_back({edit_of(scene, "desk 2").light, glm::vec3(1.0F), 500.0F, 0.5F, true});
    lighting.lamps.push_back({edit_of(scene, "spot").light, glm::vec3(1.0F), 20.0F, 1.0F, false});
    lighting.lamps.push_back({1, glm::vec3(1.0F), 100.0F, 0.25F, true});
    scene.lighting_scenes = {lighting};
    const std::string bytes = saved_bytes(scene);
    const Scene again = expect_same(scene);
    ASSERT_EQ(again.punctual_lights.size(), 4U);
    EXPECT_EQ(again.punctual_lights[2].profile, again.punctual_lights[3].profile)
        << "one file for all of a type";
    // On another machine: nothing but the file.
    std::filesystem::remove_all(folder.path() / "photometry");
    const Scene elsewhere = load_gltf(folder.write("elsewhere/scene.glb", bytes));
    EXPECT_EQ(description_of(elsewhere), description_of(again));
}

TEST_F(SavedScene, ARemovedLightIsGone) {
    Scene scene = open();
    set_light_removed(scene, edit_of(scene, "table lamp").light, true);
    EXPECT_EQ(expect_same(scene).punctual_lights.size(), 1U);
}

TEST_F(SavedScene, DaylightIsThatOfTheClockAndDimmed) {
    Scene scene = open();
    DaylightSetting daylight;
    daylight.sky = "clear";
    daylight.sun_elevation = 48.1F;
    daylight.sun_azimuth = 243.0F;
    daylight.turbidity = 3.5F;
    daylight.place = glm::vec2(52.52F, 13.4F);
    daylight.north = 12.5F;
    daylight.time = "2026-06-21T15:00:00+02:00";
    apply(scene, daylight);
    Scene again = expect_same(scene);
    EXPECT_EQ(sky_towards(again, {0.0, 0.8, 0.6}), sky_towards(scene, {0.0, 0.8, 0.6}));
    LightEdit sun = edit_of(scene, "sun");
    sun.dim = 0.4F;
    apply(scene, sun);
    LightEdit sky;
    sky.light = light_numbers(scene).back();
    ASSERT_TRUE(is_sky_light(scene, sky.light));
    sky.intensity = 4321.0F;
    apply(scene, sky);
    again = expect_same(scene);
    EXPECT_EQ(sky_towards(again, {0.0, 0.8, 0.6}), sky_towards(scene, {0.0, 0.8, 0.6}));
}

TEST_F(SavedScene, TheSkyThatServesWithoutLampsStays) {
    builder = one_triangle();
    Scene scene = open();
    ASSERT_EQ(scene.sky_radiance, glm::vec3(1000.0F));
    AddedLuminaire added;
    added.number = first_added_light;
    added.name = "lamp";
    added.photometry = "panel.ies";
    added.position = {0.0F, 2.0F, 0.0F};
    add_luminaire(scene, added);
    expect_same(scene);
}

TEST_F(SavedScene, WhatTheCommandLineSaidIsInTheFile) {
    SceneSettings settings;
    settings.metres_per_unit = 0.7F;
    settings.daylight.sky = "overcast";
    settings.daylight.ground_albedo = 0.35F;
    settings.ies = {"spot=" + (folder.path() / "photometry/panel.ies").string()};
    Scene scene = open(settings);
    object(scene, "table").transform = odd_place(-1.0F);
    scene.medium = Medium{0.01, glm::vec3(0.9F), 0.3};
    LightEdit spot = edit_of(scene, "spot");
    spot.position = glm::vec3(0.3F, 1.1F, -0.7F);
    apply(scene, spot);
    expect_same(scene);
}

}  // namespace
}  // namespace raybundle::test
