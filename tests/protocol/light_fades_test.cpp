// SPDX-License-Identifier: Apache-2.0
// Lamps that take their time, by a clock that stands still until it is set.
#include "session/light_fades.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "scene/edit/light_edit.h"
#include "session/changes/change_expansion.h"
#include "session/messages/light_messages.h"
#include "session/messages/scene_messages.h"

namespace raybundle {
namespace {

constexpr std::uint32_t panel = 1;  // a surface of 100 cd/m²
constexpr std::uint32_t spot = 2;   // of 8 cd
constexpr std::uint32_t sun = 3;    // of the sky

Scene three_lights() {
    Scene scene;
    scene.materials.resize(1);
    scene.materials[0].emission = glm::vec3(100.0F);
    scene.lights.resize(1);
    scene.lights[0].id = panel;
    scene.lights[0].material = 0;
    scene.lights[0].radiance = glm::vec3(100.0F);
    scene.punctual_lights.resize(2);
    scene.punctual_lights[0].intensity = glm::vec3(8.0F);
    scene.punctual_lights[1].kind = PunctualKind::directional;
    scene.punctual_lights[1].of_sky = true;
    scene.punctual_lights[1].intensity = glm::vec3(9e4F);
    return scene;
}

v1::SetLight set_dim(std::uint32_t light, float dim, float fade_seconds = 0.0F) {
    v1::SetLight set;
    set.set_light(light);
    set.set_dim(dim);
    if (fade_seconds > 0.0F) {
        set.set_fade_seconds(fade_seconds);
    }
    return set;
}

class LightFading : public testing::Test {
  protected:
    /// Makes a change, as ChangeCoordinator does.
    void make(const v1::SetLight& set) {
        v1::SceneChanged change;
        *change.mutable_set_light() = set;
        make(change);
    }
    void make(const v1::SceneChanged& change) {
        const LampOutputs before = {{panel, shown(panel)}, {spot, shown(spot)}};
        const v1::SceneChanged was = state_of(scene, change);
        apply(scene, change);
        v1::SceneChanged is = state_of(scene, change);
        is.set_epoch(++epoch);
        history.note(was, is);
        fades.follow(change, before, scene, clock.now());
    }
    std::vector<std::uint32_t> go_on(double seconds) {
        clock.advance_ms(1000.0 * seconds);
        return fades.advance(clock.now());
    }
    glm::vec3 shown(std::uint32_t light) {
        const ShownLamps as_shown(scene, fades);
        return lamp_output(scene, light);
    }

    ManualClock clock;
    Scene scene = three_lights();
    LightFades fades;
    SceneHistory history;
    std::uint32_t epoch = 0;
};

TEST_F(LightFading, DimmerGoesEvenlyAndEndsExactly) {
    Scene at_once = scene;
    apply(at_once, from_message(set_dim(panel, 0.3F)));
    make(set_dim(panel, 0.3F, 2.0F));
    EXPECT_EQ(shown(panel), glm::vec3(100.0F)) << "as it was, at first";
    EXPECT_EQ(go_on(0.5), std::vector{panel});
    EXPECT_FLOAT_EQ(shown(panel).g, 82.5F);
    EXPECT_EQ(go_on(1.0), std::vector{panel});
    EXPECT_FLOAT_EQ(shown(panel).g, 47.5F);
    EXPECT_TRUE(go_on(0.0).empty()) << "no time, no step";
    EXPECT_EQ(go_on(7.0), std::vector{panel});
    EXPECT_EQ(shown(panel), lamp_output(at_once, panel)) << "to the bit";
    EXPECT_FALSE(fades.running());
}

TEST_F(LightFading, ColourAndSwitchGoStraightInEachChannel) {
    v1::SetLight red;
    red.set_light(spot);
    red.mutable_colour()->set_x(1.0F);
    red.set_fade_seconds(4.0F);
    make(red);
    const glm::vec3 end = lamp_output(scene, spot);
    ASSERT_EQ(end.b, 0.0F);
    go_on(1.0);
    EXPECT_FLOAT_EQ(shown(spot).r, 0.75F * 8.0F + 0.25F * end.r);
    EXPECT_FLOAT_EQ(shown(spot).b, 6.0F);
    v1::SetLight off;
    off.set_light(spot);
    off.set_on(false);
    off.set_fade_seconds(1.0F);
    const glm::vec3 before = shown(spot);
    make(off);
    go_on(0.5);
    EXPECT_FLOAT_EQ(shown(spot).r, 0.5F * before.r);
    go_on(0.5);
    EXPECT_EQ(shown(spot), glm::vec3(0.0F));
}

/// What is saved, listed, reported and dimmed further is what was asked for.
TEST_F(LightFading, TheSceneHasTheEndAtOnce) {
    make(set_dim(spot, 0.25F, 10.0F));
    go_on(1.0);
    EXPECT_EQ(state_of_light(scene, spot).dim(), 0.25F);
    EXPECT_EQ(lamp_output(scene, spot), glm::vec3(2.0F));
    EXPECT_FLOAT_EQ(shown(spot).g, 7.4F);
    EXPECT_EQ(lamp_output(scene, spot), glm::vec3(2.0F)) << "again, once it has been shown";
    v1::Scene told;
    fades.describe(clock.now(), &told);
    ASSERT_EQ(told.fades_size(), 1);
    EXPECT_EQ(told.fades(0).light(), spot);
    EXPECT_FLOAT_EQ(told.fades(0).seconds(), 9.0F);
}

TEST_F(LightFading, TheNewerChangeOfALampWins) {
    make(set_dim(panel, 0.0F, 2.0F));
    make(set_dim(spot, 0.0F, 2.0F));
    go_on(1.0);
    make(set_dim(panel, 0.9F));
    EXPECT_FLOAT_EQ(shown(panel).g, 90.0F) << "at once";
    EXPECT_EQ(fades.lamps(), std::vector{spot}) << "others go on";
    make(set_dim(spot, 1.0F, 1.0F));
    EXPECT_FLOAT_EQ(shown(spot).g, 4.0F) << "from where it was";
    go_on(0.5);
    EXPECT_FLOAT_EQ(shown(spot).g, 6.0F);
    make(set_dim(spot, 1.0F, 5.0F));
    go_on(4.0);
    EXPECT_TRUE(fades.running()) << "to the same end, more slowly";
    EXPECT_LT(shown(spot).g, 8.0F);
}

TEST_F(LightFading, PlaceAndGroupLeaveItBeAndRemovalEndsIt) {
    make(set_dim(spot, 0.0F, 2.0F));
    go_on(1.0);
    v1::SetLight moved;
    moved.set_light(spot);
    moved.set_group("desks");
    moved.mutable_position()->set_x(1.0F);
    make(moved);
    EXPECT_FLOAT_EQ(shown(spot).g, 4.0F);
    v1::SceneChanged gone;
    gone.mutable_add_luminaire()->set_light(spot);
    gone.mutable_add_luminaire()->set_removed(true);
    make(gone);
    EXPECT_FALSE(fades.running());
    EXPECT_EQ(shown(spot), glm::vec3(0.0F));
}

TEST_F(LightFading, WhatIsSoAlreadyDoesNotFade) {
    make(set_dim(panel, 1.0F, 5.0F));
    EXPECT_FALSE(fades.running());
    make(set_dim(panel, 0.5F));
    EXPECT_FALSE(fades.running());
}

TEST_F(LightFading, NobodyWhoLooksGetsTheEndAlone) {
    EXPECT_FALSE(fades.due(clock.now(), true));
    make(set_dim(panel, 0.5F, 2.0F));
    EXPECT_FALSE(fades.due(clock.now(), true)) << "nothing is otherwise yet";
    clock.advance_ms(100.0);
    EXPECT_TRUE(fades.due(clock.now(), true));
    EXPECT_FALSE(fades.due(clock.now(), false));
    clock.advance_ms(1900.0);
    EXPECT_TRUE(fades.due(clock.now(), false));
}

TEST_F(LightFading, AnUndoTakesAllOfItBackAtOnce) {
    make(set_dim(panel, 0.0F, 2.0F));
    go_on(1.0);
    const auto changes = history.back_to(0);
    ASSERT_TRUE(changes && changes->size() == 1);
    EXPECT_FALSE(changes->front().set_light().has_fade_seconds());
    make(changes->front());
    EXPECT_FLOAT_EQ(shown(panel).g, 100.0F);
    EXPECT_FALSE(fades.running());
}

/// However often: a lamp has one fade, and none is longer than a minute, whoever wrote it.
TEST_F(LightFading, AreAsManyAsLampsAtMost) {
    scene.punctual_lights.resize(200);
    for (int round = 0; round < 3; ++round) {
        for (std::uint32_t light = 2; light <= 201; ++light) {
            v1::SceneChanged change;
            *change.mutable_set_light() = set_dim(light, 0.1F * static_cast<float>(round), 1e9F);
            const LampOutputs before = {{light, glm::vec3(static_cast<float>(round + 1))}};
            apply(scene, change);
            fades.follow(change, before, scene, clock.now());
        }
    }
    EXPECT_EQ(fades.lamps().size(), 200U);
    EXPECT_EQ(go_on(60.0).size(), 200U);
    EXPECT_FALSE(fades.running());
}

TEST_F(LightFading, AGroupAndALightingSceneFadeInAllTheirLamps) {
    ChangeLog log;
    LightingScenes lighting(log);
    ASSERT_TRUE(lighting.save("bright", "Ada", scene));
    const PatchMesh mesh;
    for (const std::uint32_t light : {panel, spot, sun}) {
        v1::SetLight joins;
        joins.set_light(light);
        joins.set_group("all");
        apply(scene, from_message(joins));
    }
    const auto ask = [&](std::initializer_list<v1::ClientMessage> messages) {
        PendingChange pending;
        for (const v1::ClientMessage& message : messages) {
            pending.requests.emplace_back().message = message;
        }
        return expand(pending, scene, mesh, log, lighting).changes;
    };
    v1::ClientMessage dim;
    dim.mutable_set_group()->set_group("all");
    dim.mutable_set_group()->set_dim(0.5F);
    dim.mutable_set_group()->set_fade_seconds(3.0F);
    const std::vector<v1::SceneChanged> dimmed = ask({dim});
    ASSERT_EQ(dimmed.size(), 3U);
    EXPECT_EQ(dimmed[0].set_light().fade_seconds(), 3.0F);
    EXPECT_EQ(dimmed[1].set_light().fade_seconds(), 3.0F);
    EXPECT_FALSE(dimmed[2].set_light().has_fade_seconds()) << "the sun goes by the day";
    v1::ClientMessage at_once = dim;
    at_once.mutable_set_group()->clear_fade_seconds();
    EXPECT_FALSE(ask({dim, at_once})[0].set_light().has_fade_seconds()) << "the newest counts";
    apply(scene, dimmed[0]);
    v1::ClientMessage bright;
    bright.mutable_apply_lighting_scene()->set_name("bright");
    bright.mutable_apply_lighting_scene()->set_fade_seconds(5.0F);
    const std::vector<v1::SceneChanged> applied = ask({bright});
    ASSERT_EQ(applied.size(), 1U);
    EXPECT_EQ(applied[0].set_light().fade_seconds(), 5.0F);
}

TEST(LightFadesInTheLog, ARestartedServerHasTheEndAndKnowsHowItCame) {
    std::string pattern = std::filesystem::temp_directory_path() / "raybundle_fades_XXXXXX";
    const std::filesystem::path folder = mkdtemp(pattern.data());
    JournalSettings settings;
    settings.file = folder / "session.db";
    settings.scene_name = "room";
    settings.scene_digest = "digest";
    {
        ChangeLog log(settings);
        Scene scene = three_lights();
        for (const v1::SetLight& set :
             {set_dim(panel, 0.25F, 30.0F), set_dim(spot, 0.5F, 30.0F), set_dim(spot, 0.75F)}) {
            v1::SceneChanged change;
            *change.mutable_set_light() = set;
            EXPECT_EQ(log.record(change, state_of(scene, change)), Recorded::yes);
            apply(scene, change);
        }
    }
    ChangeLog log(settings);
    Scene scene = three_lights();
    PatchMesh mesh;
    log.restore(scene, mesh);
    EXPECT_EQ(lamp_output(scene, panel), glm::vec3(25.0F));
    EXPECT_EQ(lamp_output(scene, spot), glm::vec3(6.0F));
    v1::ChangeHistory told;
    log.records().fill(&told);
    ASSERT_GE(told.changes_size(), 2);
    EXPECT_EQ(told.changes(0).set_light().dim(), 0.25F);
    EXPECT_EQ(told.changes(0).light_before().dim(), 1.0F);
    EXPECT_EQ(told.changes(0).set_light().fade_seconds(), 30.0F);
    EXPECT_FALSE(told.changes(told.changes_size() - 1).set_light().has_fade_seconds());
    const auto back = log.history().back_to(0);
    ASSERT_TRUE(back && back->size() == 2);
    EXPECT_FALSE(back->front().set_light().has_fade_seconds());
    std::filesystem::remove_all(folder);
}

TEST(LightFadesInTheQueue, TheNewestSettingOfALightSaysHowLongItTakes) {
    v1::SceneChanged sum, newer;
    *sum.mutable_set_light() = set_dim(1, 0.5F, 3.0F);
    newer.mutable_set_light()->set_light(1);
    newer.mutable_set_light()->set_group("desks");
    add_change(newer, sum);
    EXPECT_EQ(sum.set_light().fade_seconds(), 3.0F) << "a group says nothing of it";
    *newer.mutable_set_light() = set_dim(1, 0.25F);
    add_change(newer, sum);
    EXPECT_FALSE(sum.set_light().has_fade_seconds());
    EXPECT_EQ(sum.set_light().dim(), 0.25F);
}

}  // namespace
}  // namespace raybundle
