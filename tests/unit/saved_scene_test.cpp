// SPDX-License-Identifier: Apache-2.0
// A scene that has been edited, saved and loaded again is the same scene.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "saved_scene_room.h"
#include "scene/edit/surface_edit.h"
#include "scene/mesh/mesh_growth.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle::test {
namespace {

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