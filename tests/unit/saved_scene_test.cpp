// SPDX-License-Identifier: Apache-2.0
// A scene that has been edited, saved and loaded again is the same scene.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/gtc/quaternion.hpp>

#include "saved_scene_description.h"
#include "scene/edit/daylight_edit.h"
#include "scene/edit/light_edit.h"
#include "scene/edit/luminaire_edit.h"
#include "scene/edit/surface_edit.h"
#include "scene/light/environment.h"
#include "scene/mesh/mesh_growth.h"
#include "scene/mesh/patch_mesh.h"
#include "scene/scene_folder.h"

namespace raybundle::test {
namespace {

constexpr const char* ies_text =
    "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0.1 0.1 0\n1 1 20\n0 45 90\n0\n800 400 0\n";

/// An offset that is not exact in single precision, turned and stretched.
Transform odd_place(float x) {
    Transform place;
    place.translation = {x + 0.1F, 0.7F / 3.0F, -0.3F};
    place.rotation = glm::normalize(glm::quat(0.3F, 0.1F, -0.7F, 0.2F));
    place.scale = {1.1F, 0.9F, 1.3F};
    return place;
}

/// A room of a floor, a table with a lamp on it below another node, a shelf, a spot and a panel.
class SavedScene : public testing::Test {
  protected:
    SavedScene() {
        const int floor = builder.add_material({{"name", "floor"}});
        const int wood = builder.add_material(
            {{"name", "wood"},
             {"pbrMetallicRoughness",
              {{"baseColorFactor", {0.3, 0.2, 0.1, 1}}, {"roughnessFactor", 0.4}}}});
        const int glow = builder.add_material(
            {{"name", "panel"},
             {"emissiveFactor", {1, 0.9, 0.7}},
             {"extensions", {{"KHR_materials_emissive_strength", {{"emissiveStrength", 900}}}}}});
        builder.json["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_emissive_strength"};
        builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {
            {{"type", "point"}, {"intensity", 120}, {"color", {1, 0.8, 0.6}}},
            {{"type", "spot"}, {"intensity", 700}, {"spot", {{"outerConeAngle", 0.6}}}}};
        add_box("ground", {-5, -0.2, -5}, {5, 0, 5}, floor, {});
        const int table = add_box("table", {0, 0, 0}, {1, 0.7, 1}, wood,
                                  {{"translation", {0.5, 0, 0.2}}, {"extras", {{"asset", 7}}}});
        const int lamp = builder.add_node(
            {{"name", "table lamp"}, {"translation", {0.3, 1.1, 0.2}}, {"extensions", light(0)}},
            false);
        builder.json["nodes"][table]["children"] = {lamp};
        add_box("shelf", {0, 0, 0}, {0.5, 2, 0.3}, wood,
                {{"matrix", {0.8, 0, -0.6, 0, 0, 1, 0, 0, 0.6, 0, 0.8, 0, -2, 0, 1, 1}}});
        add_box("panel", {-0.5, 2.5, -0.5}, {0.5, 2.55, 0.5}, glow, {});
        const int high = builder.add_node({{"name", "track"}, {"translation", {1, 2.4, 1}}});
        const int spot = builder.add_node(
            {{"name", "spot"}, {"rotation", {-0.6, 0, 0, 0.8}}, {"extensions", light(1)}}, false);
        builder.json["nodes"][high]["children"] = {spot};
        std::filesystem::create_directories(folder.path() / "photometry");
        folder.write("photometry/panel.ies", ies_text);
    }

    static Json light(int index) { return {{"KHR_lights_punctual", {{"light", index}}}}; }

    int add_box(const std::string& name, const glm::vec3& low, const glm::vec3& high, int material,
                Json node) {
        const int mesh = builder.add_box_mesh(low, high);
        builder.json["meshes"][mesh]["primitives"][0]["material"] = material;
        node["mesh"] = mesh;
        node["name"] = name;
        return builder.add_node(node);
    }

    Scene open(const SceneSettings& settings = {}) {
        Scene scene = load_gltf(folder.write("room.gltf", builder.text()), settings);
        scene.folder = std::make_shared<const SceneFolder>(folder.path());
        return scene;
    }

    static Object& object(Scene& scene, const std::string& name) {
        for (Object& found : scene.objects) {
            if (found.name == name) {
                return found;
            }
        }
        throw std::runtime_error("no object " + name);
    }

    static LightEdit edit_of(const Scene& scene, const std::string& name) {
        LightEdit edit;
        for (const std::uint32_t number : light_numbers(scene)) {
            const auto index = punctual_index(scene, number);
            const bool area = number <= scene.lights.size();
            if ((index && scene.punctual_lights[*index].name == name) ||
                (area && scene.lights[number - 1].name == name)) {
                edit.light = number;
            }
        }
        return edit;
    }

    /// Saved, it is the same, and saving it again makes the same file.
    Scene expect_same(const Scene& scene) {
        const std::string bytes = saved_bytes(scene);
        EXPECT_EQ(glb_problem(bytes), "");
        Scene again = load_gltf(folder.write("saved/scene.glb", bytes));
        EXPECT_EQ(description_of(again), description_of(scene))
            << Json::diff(description_of(scene), description_of(again)).dump(1);
        EXPECT_TRUE(saved_bytes(again) == bytes) << "the second file differs";
        again.folder = scene.folder;
        return again;
    }

    GltfBuilder builder;
    TemporaryFolder folder;
};

TEST_F(SavedScene, UnchangedIsTheSame) {
    const Scene scene = open();
    ASSERT_EQ(scene.objects.size(), 4U);
    const Scene again = expect_same(scene);
    EXPECT_EQ(again.triangles.size(), scene.triangles.size());
}

TEST_F(SavedScene, MovedObjectsAreWhereTheyAreWithWhatTheyCarry) {
    Scene scene = open();
    object(scene, "table").transform = odd_place(-1.0F);
    object(scene, "shelf").transform = odd_place(2.0F);
    Scene again = expect_same(scene);
    EXPECT_EQ(place_light(again, again.punctual_lights[0]).position,
              place_light(scene, scene.punctual_lights[0]).position);
    // For other programs, too: it is the node that has moved.
    const std::string bytes = saved_bytes(scene);
    const Json json = Json::parse(bytes.substr(20, bytes.find("BIN", 20) - 24));
    EXPECT_EQ(json["nodes"][1]["translation"][0].get<float>(), -0.9F);
    EXPECT_EQ(json["nodes"][1]["extras"]["asset"], 7) << "what others have written stays";
}

TEST_F(SavedScene, ShearedNodesMoveInTheWorld) {
    add_box("sheared", {0, 0, 0}, {1, 1, 1}, 1,
            {{"matrix", {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 1, 0, 3, 1}}});
    Scene scene = open();
    Object& sheared = object(scene, "sheared");
    sheared.transform.translation += glm::vec3(0.5F, 0.25F, -1.0F);
    Scene again = saved_and_loaded(scene, folder);
    const auto corner = [](Scene& of) {
        const Object& at = object(of, "sheared");
        return glm::vec3(at.placement() * glm::vec4(at.bounds.max, 1.0F));
    };
    EXPECT_LT(glm::distance(corner(scene), corner(again)), 1e-5F);
}

TEST_F(SavedScene, RemovedObjectsAreGoneWithTheirLights) {
    Scene scene = open();
    object(scene, "table").removed = true;
    const Scene again = expect_same(scene);
    EXPECT_EQ(again.objects.size(), 3U);
    EXPECT_EQ(again.punctual_lights.size(), 1U);
    EXPECT_EQ(again.punctual_lights[0].name, "spot");
}

TEST_F(SavedScene, TheLastObjectIsNotTakenApart) {
    Scene scene = open();
    for (const char* name : {"table", "shelf", "panel"}) {
        object(scene, name).removed = true;
    }
    scene.lights.clear();  // its surface has gone
    EXPECT_EQ(expect_same(scene).objects.size(), 1U);
}

TEST_F(SavedScene, CopiesAndObjectsOfFilesAreObjects) {
    GltfBuilder chair;
    const std::vector<std::uint8_t> pixels(std::size_t{4} * 4 * 4, 200);
    chair.json["images"] = {
        {{"bufferView", chair.add_view(png(4, 4, pixels))}, {"mimeType", "image/png"}}};
    chair.json["textures"] = {{{"source", 0}}};
    chair.add_material({{"name", "unused"}});
    chair.add_material(
        {{"name", "cloth"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    Json primitive = {{"attributes",
                       {{"POSITION", chair.add_positions(unit_triangle)},
                        {"TEXCOORD_0", chair.add_uvs({{0, 0}, {1, 0}, {0, 1}})}}},
                      {"material", 1}};
    chair.add_node({{"mesh", chair.add_mesh(primitive)}, {"name", "seat"}});
    chair.add_node({{"mesh", chair.add_box_mesh({0, 0, 0}, {0.2, 1, 0.2})}, {"name", "legs"}});
    folder.write("chair.glb", chair.glb());

    Scene scene = open();
    PatchMesh mesh = tessellate(scene, {});
    const auto add = [&](std::uint32_t copy_of, const std::string& library, float x) {
        AddedObject added;
        added.copy_of = copy_of;
        added.library = library;
        added.name = library + std::to_string(copy_of);
        added.transform = odd_place(x);
        add_object(scene, mesh, added);
        scene.objects.back().removed = false;
    };
    add(object(scene, "table").id, "", 1.0F);
    add(0, "chair.glb", -2.0F);
    add(6, "", 2.5F);  // a copy of the chair
    add(5, "", -3.0F);
    scene.objects[4].removed = true;  // the copy that has been copied
    object(scene, "table").transform = odd_place(0.0F);
    MaterialEdit cloth;
    cloth.material = 5;
    ASSERT_EQ(scene.materials[4].name, "cloth");
    cloth.base_colour = glm::vec3(0.1F, 0.7F, 0.3F);
    apply(scene, cloth);
    const Scene again = expect_same(scene);
    ASSERT_EQ(again.objects.size(), 7U);
    EXPECT_EQ(again.textures.size(), 1U);
    EXPECT_EQ(again.objects[5].added, nullptr) << "the file has it now";
}

TEST_F(SavedScene, MaterialsAreAsEdited) {
    builder.add_material(
        {{"name", "glossy"},
         {"extensions", {{"KHR_materials_pbrSpecularGlossiness", {{"glossinessFactor", 0.3}}}}}});
    builder.add_material(
        {{"name", "lampshade"},
         {"extensions",
          {{"KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", 0.4}}}}}});
    Scene scene = open();
    for (std::uint32_t m = 1; m <= scene.materials.size(); ++m) {
        MaterialEdit edit;
        edit.material = m;
        edit.base_colour = glm::vec3(0.1F, 0.2F, 0.3F) * static_cast<float>(m) / 3.0F;
        if (!transmits(scene.materials[m - 1])) {
            edit.roughness = 0.7F / static_cast<float>(m);
            edit.metallic = 0.1F * static_cast<float>(m);
        }
        ASSERT_EQ(problem_of(scene, edit), "");
        apply(scene, edit);
    }
    expect_same(scene);
}

TEST_F(SavedScene, WhatOtherProgramsHaveSetCounts) {
    Scene scene = open();
    MaterialEdit edit;
    edit.material = 2;
    edit.roughness = 0.9F;
    apply(scene, edit);
    LightEdit dimmed = edit_of(scene, "spot");
    dimmed.dim = 0.5F;
    dimmed.group = "wall";
    apply(scene, dimmed);
    const std::string bytes = saved_bytes(scene);
    const std::size_t length = bytes.find("BIN", 20) - 24;
    Json json = Json::parse(bytes.substr(20, length));
    json["materials"][1]["pbrMetallicRoughness"]["roughnessFactor"] = 0.25;
    for (Json& light : json["extensions"]["KHR_lights_punctual"]["lights"]) {
        light["intensity"] = 50;
    }
    std::string text = json.dump();
    ASSERT_LE(text.size(), length);
    text.resize(length, ' ');
    std::string changed = bytes;
    changed.replace(20, length, text);
    const Scene again = load_gltf(folder.write("changed.glb", changed));
    EXPECT_EQ(again.materials[1].roughness, 0.25F);
    EXPECT_EQ(again.punctual_lights[1].intensity, glm::vec3(50.0F));
    EXPECT_EQ(again.punctual_lights[1].control.dim, 1.0F);
    EXPECT_EQ(again.punctual_lights[1].control.group, "wall") << "glTF says nothing of that";
}

TEST_F(SavedScene, LightsAreSetDimmedGroupedAndPlaced) {
    Scene scene = open();
    LightEdit lamp = edit_of(scene, "table lamp");
    lamp.intensity = 77.7F;
    lamp.colour = glm::vec3(0.2F, 0.5F, 0.9F);
    lamp.dim = 0.3F;
    lamp.group = "tables";
    lamp.maintenance_factor = 0.67F;
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

TEST_F(SavedScene, PartsOfAnUndividedFileCanBeMovedAndRemoved) {
    builder = GltfBuilder();
    std::vector<glm::vec3> corners;
    const auto add = [&](const glm::vec3& low, const glm::vec3& high) {
        for (const auto& [a, b] : {std::pair{0, 1}, std::pair{1, 2}, std::pair{2, 0}}) {
            for (const float side : {0.0F, 1.0F}) {
                const auto corner = [&](float u, float v) {
                    glm::vec3 p(side);
                    p[a] = u;
                    p[b] = v;
                    return low + p * (high - low);
                };
                for (const glm::vec2 uv :
                     {glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}) {
                    corners.push_back(side > 0.0F ? corner(uv.x, uv.y) : corner(uv.y, uv.x));
                }
            }
        }
    };
    add({-5, -0.2, -5}, {5, 0, 5});
    add({1, 0, 1}, {2, 1, 2});
    add({-2, 0, -1}, {-1, 1.5, 0});
    builder.add_node({{"mesh", builder.add_triangle_mesh(corners)},
                      {"name", "all"},
                      {"translation", {0.1, 0.2, 0.3}},
                      {"extras", {{"movable", false}}}});
    Scene scene = open();
    ASSERT_EQ(scene.objects.size(), 3U);
    expect_same(scene);
    scene.objects[1].transform = odd_place(0.5F);
    Scene again = expect_same(scene);
    EXPECT_EQ(again.triangles.size(), scene.triangles.size());
    scene.objects[2].removed = true;
    EXPECT_EQ(expect_same(scene).objects.size(), 2U);
}

TEST_F(SavedScene, WhatHangsBelowAMovedObjectStays) {
    // A cupboard whose door is animated: another object, which does not move with it.
    const int cupboard =
        add_box("cupboard", {0, 0, 0}, {1, 2, 0.6}, 1, {{"translation", {-4, 0, -4}}});
    const int door = add_box("door", {0, 0, 0}, {1, 2, 0.05}, 1, {{"translation", {0, 0, 0.6}}});
    builder.json["scenes"][0]["nodes"].erase(builder.json["scenes"][0]["nodes"].size() - 1);
    builder.json["nodes"][cupboard]["children"] = {door};
    const int times =
        builder.add_accessor(builder.add_view_of(std::vector<float>{0, 1}), 5126, 2, "SCALAR");
    builder.json["accessors"][times]["min"] = {0};
    builder.json["accessors"][times]["max"] = {1};
    const int places = builder.add_accessor(
        builder.add_view_of(std::vector<glm::vec3>{{0, 0, 0.6}, {1, 0, 0.6}}), 5126, 2, "VEC3");
    builder.json["animations"] = {
        {{"name", "open"},
         {"samplers", {{{"input", times}, {"output", places}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", door}, {"path", "translation"}}}}}}}};
    Scene scene = open();
    ASSERT_TRUE(scene.animations);
    object(scene, "cupboard").transform = odd_place(1.0F);
    object(scene, "door").transform.translation.x += 0.3F;
    const Scene again = expect_same(scene);
    EXPECT_TRUE(again.animations) << "the door still opens";
}

TEST_F(SavedScene, OtherFilesAreInTheFile) {
    folder.write("more/geometry.bin",
                 std::string_view(reinterpret_cast<const char*>(builder.buffer().data()),
                                  builder.buffer().size()));
    const std::vector<std::uint8_t> image = png(2, 2, std::vector<std::uint8_t>(16, 99));
    folder.write("more/a b.png",
                 std::string_view(reinterpret_cast<const char*>(image.data()), image.size()));
    folder.write("more/lamp.ies", ies_text);
    builder.json["images"] = {{{"uri", "a%20b.png"}}};
    builder.json["textures"] = {{{"source", 0}}};
    builder.json["materials"][1]["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    builder.json["extensions"]["EXT_lights_ies"]["lights"] = {{{"uri", "lamp.ies"}}};
    builder.json["extensionsUsed"].push_back("EXT_lights_ies");
    builder.add_node({{"name", "hall"},
                      {"translation", {0, 2, 0}},
                      {"extensions", {{"EXT_lights_ies", {{"light", 0}}}}}});
    Json json = Json::parse(builder.text(false));
    json["buffers"][0]["uri"] = "geometry.bin";
    Scene scene = load_gltf(folder.write("more/room.gltf", json.dump()));
    const std::string bytes = saved_bytes(scene);
    std::filesystem::remove_all(folder.path() / "more");
    EXPECT_EQ(glb_problem(bytes), "");
    const Scene again = load_gltf(folder.write("alone/room.glb", bytes));
    EXPECT_EQ(description_of(again), description_of(scene));
    EXPECT_EQ(again.textures[0].rgba, scene.textures[0].rgba);
    EXPECT_EQ(again.punctual_lights.front().photometry, "lamp.ies");
}

TEST_F(SavedScene, AnotherFileUnderTheNameIsRefused) {
    const Scene scene = open();
    builder.add_node({{"name", "more"}});
    folder.write("room.gltf", builder.text());
    try {
        saved_bytes(scene);
        FAIL();
    } catch (const SceneError& error) {
        EXPECT_EQ(error.file(), scene.path);
        EXPECT_NE(error.reason().find("has changed"), std::string::npos) << error.reason();
    }
    Scene none = scene;
    none.source = nullptr;
    EXPECT_THROW(saved_bytes(none), SceneError);
}

/// Files of others, with everything moved and dimmed that can be.
TEST(SavedSceneCorpus, FilesOfOthersAreTheSame) {
    const std::filesystem::path data = RAYBUNDLE_SHARED_DATA;
    if (!std::filesystem::exists(data)) {
        GTEST_SKIP() << "no third-party data beside the repository";
    }
    const TemporaryFolder folder;
    for (const char* name :
         {"scenes/bevy_cornell_box/CornellBox.glb", "scenes/godot_town_lamp/scene.gltf",
          "conformance/assimp_textureTransform/TextureTransformTest.gltf",
          "conformance/assimp_BoxTextured-glTF/BoxTextured.gltf",
          "animation/bevy_simple_skin/SimpleSkin.gltf", "conformance/assimp_cameras/Cameras.gltf",
          "conformance/assimp_BoxTextured-glTF-pbrSpecularGlossiness/BoxTextured.gltf"}) {
        SCOPED_TRACE(name);
        Scene scene = load_gltf((data / name).string());
        float x = 0.0F;
        for (Object& object : scene.objects) {
            if (object.movable) {
                object.transform.translation += glm::vec3(x += 0.1F, 0.05F, -0.02F);
            }
        }
        for (const std::uint32_t number : light_numbers(scene)) {
            LightEdit edit;
            edit.light = number;
            edit.intensity = 123.4F;
            if (problem_of(scene, edit).empty()) {
                apply(scene, edit);
            }
        }
        const std::string bytes = saved_bytes(scene);
        EXPECT_EQ(glb_problem(bytes), "");
        const Scene again = load_gltf(folder.write("scene.glb", bytes));
        EXPECT_EQ(description_of(again), description_of(scene))
            << Json::diff(description_of(scene), description_of(again)).dump(1);
        EXPECT_TRUE(saved_bytes(again) == bytes);
    }
}

}  // namespace
}  // namespace raybundle::test
