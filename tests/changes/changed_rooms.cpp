// SPDX-License-Identifier: Apache-2.0
#include "changed_rooms.h"

#include "oracle/scene_builder.h"

namespace raybundle {

namespace {

constexpr float lamp_luminance = 1000.0F;  // cd/m²

Scene finish(SceneBuilder& b) {
    Scene scene = b.loaded_scene();
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        scene.lights[i].name = "lamp" + std::to_string(i);
    }
    return scene;
}

std::uint32_t add_wall(SceneBuilder& b, float albedo = 0.7F) {
    Material wall;
    wall.name = "wall";
    wall.base_colour = glm::vec3(albedo);
    wall.metallic = 0.0F;
    wall.specular = 0.0F;
    return b.add_material(wall);
}

std::uint32_t add_lamp(SceneBuilder& b, float luminance) {
    return b.add_material(glm::vec3(0.5F), glm::vec3(luminance));
}

std::uint32_t add_pane(SceneBuilder& b, const glm::vec3& colour) {
    Material pane;
    pane.base_colour = colour;
    pane.metallic = 0.0F;
    pane.roughness = 0.0F;
    pane.transmission = 1.0F;
    return b.add_material(pane);
}

}  // namespace

Scene two_rooms() {
    SceneBuilder b;
    const auto wall = add_wall(b);
    for (const float x : {0.0F, 10.0F}) {
        const auto lamp = add_lamp(b, lamp_luminance);
        b.add_object(x == 0.0F ? "first" : "second");
        b.add_box({x, 0, 0}, {x + 4, 4, 4}, true, 1, wall);
        b.add_quad({x + 1.5F, 3.9F, 1.5F}, {1, 0, 0}, {0, 0, 1}, 1, 1, lamp);
    }
    Transform below;
    below.translation = {0, -12, 0};
    b.add_object("hood", below);
    b.add_box({1.3F, 3.6F, 1.3F}, {2.7F, 3.98F, 2.7F}, true, 1, wall);
    b.add_box({1.25F, 3.55F, 1.25F}, {2.75F, 3.99F, 2.75F}, false, 1, wall);
    return finish(b);
}

Scene furnished_room() {
    SceneBuilder b;
    const auto wall = add_wall(b);
    const auto lamp = add_lamp(b, lamp_luminance);
    b.add_box({0, 0, 0}, {6, 3, 6}, true, 1, wall);
    b.add_quad({2.5F, 2.95F, 2.5F}, {1, 0, 0}, {0, 0, 1}, 1, 1, lamp);
    const auto add_thing = [&](const std::string& name, const glm::vec3& at, float size) {
        Transform place;
        place.translation = at;
        b.add_object(name, place);
        b.add_box(glm::vec3(-0.5F * size), glm::vec3(0.5F * size), false, 1, wall);
    };
    add_thing("thing", {3, 0.8F, 2.5F}, 0.8F);
    for (int i = 0; i < 30; ++i) {
        add_thing("thing" + std::to_string(i),
                  {0.6F + 0.9F * static_cast<float>(i % 6), 0.15F,
                   0.6F + 1.1F * static_cast<float>(i / 6)},
                  0.3F);
    }
    return finish(b);
}

Scene plastic_room() {
    SceneBuilder b;
    Material plastic;
    plastic.name = "wall";
    plastic.base_colour = glm::vec3(0.7F);
    plastic.metallic = 0.0F;
    plastic.roughness = 0.5F;
    const auto wall = b.add_material(plastic);
    const auto lamp = add_lamp(b, lamp_luminance);
    b.add_box({0, 0, 0}, {4, 3, 4}, true, 1, wall);
    b.add_quad({1.5F, 2.95F, 1.5F}, {1, 0, 0}, {0, 0, 1}, 1, 1, lamp);
    return finish(b);
}

Scene rooms_with_opening() {
    SceneBuilder b;
    const auto wall = add_wall(b);
    const auto bright = add_lamp(b, lamp_luminance);
    const auto faint = add_lamp(b, 0.01F * lamp_luminance);
    const auto clear = add_pane(b, glm::vec3(1.0F));
    const auto dark = add_pane(b, glm::vec3(0.3F));
    for (const float z : {0.0F, 4.1F}) {
        b.add_quad({0, 0, z}, {0, 0, 4}, {4, 0, 0}, 1, 1, wall);  // floor
        b.add_quad({0, 3, z}, {4, 0, 0}, {0, 0, 4}, 1, 1, wall);  // ceiling
        b.add_quad({0, 0, z}, {0, 3, 0}, {0, 0, 4}, 1, 1, wall);  // x = 0
        b.add_quad({4, 0, z}, {0, 0, 4}, {0, 3, 0}, 1, 1, wall);  // x = 4
    }
    b.add_quad({0, 0, 0}, {4, 0, 0}, {0, 3, 0}, 1, 1, wall);     // z = 0
    b.add_quad({0, 0, 8.1F}, {0, 3, 0}, {4, 0, 0}, 1, 1, wall);  // z = 8.1
    b.add_box({0, 0, 4}, {1.25F, 3, 4.1F}, false, 1, wall);      // beside the opening
    b.add_box({2.75F, 0, 4}, {4, 3, 4.1F}, false, 1, wall);
    b.add_box({1.25F, 2, 4}, {2.75F, 3, 4.1F}, false, 1, wall);         // above it
    b.add_quad({1.25F, 0, 4}, {0, 0, 0.1F}, {1.5F, 0, 0}, 1, 1, wall);  // its sill
    b.add_quad({1.7F, 2.95F, 5.9F}, {0.6F, 0, 0}, {0, 0, 0.6F}, 1, 1, faint);
    b.add_object("lamp");
    b.add_quad({1.6F, 2.9F, 1.6F}, {0.8F, 0, 0}, {0, 0, 0.8F}, 1, 1, bright);
    for (const bool is_dark : {false, true}) {
        Transform outside;
        outside.translation = {is_dark ? 8.0F : -8.0F, 0, 0};
        b.add_object(is_dark ? "dark" : "clear", outside);
        b.add_quad({1.25F, 0, 4.05F}, {1.5F, 0, 0}, {0, 2, 0}, 1, 1, is_dark ? dark : clear);
    }
    return finish(b);
}

Scene room_with_mirror() {
    SceneBuilder b;
    const auto wall = add_wall(b);
    const auto lamp = add_lamp(b, lamp_luminance);
    Material silver;
    silver.base_colour = glm::vec3(0.95F);
    silver.roughness = 0.0F;
    silver.double_sided = true;
    const auto mirror = b.add_material(silver);
    b.add_box({0, 0, 0}, {5, 3, 5}, true, 1, wall);
    b.add_quad({0.4F, 2.9F, 2.0F}, {1, 0, 0}, {0, 0, 1}, 1, 1, lamp);
    Transform middle;
    middle.translation = {2.5F, 1.4F, 2.5F};
    b.add_object("mirror", middle);
    b.add_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, 1, 1, mirror);
    return finish(b);
}

}  // namespace raybundle
