// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <stdexcept>
#include <string>

#include "saved_scene_description.h"
#include "scene/edit/light_edit.h"
#include "scene/scene_folder.h"

namespace raybundle::test {

inline constexpr const char* ies_text =
    "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0.1 0.1 0\n1 1 20\n0 45 90\n0\n800 400 0\n";

/// An offset that is not exact in single precision, turned and stretched.
inline Transform odd_place(float x) {
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

}  // namespace raybundle::test
