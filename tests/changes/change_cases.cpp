// SPDX-License-Identifier: Apache-2.0
// The cases of numerics.md, second part, Changes.
#include <stdexcept>

#include "changed_rooms.h"
#include "changed_scene.h"

namespace raybundle {

namespace {

const glm::vec3 open_room_eye(2.0F, 2.0F, 0.4F);
const glm::vec3 open_room_target(2.0F, 1.6F, 4.0F);

ChangeCase open_room(const std::string& name, const std::string& file,
                     std::vector<std::vector<Edit>> changes) {
    return {.name = name,
            .file = file,
            .before = {},
            .changes = std::move(changes),
            .eye = open_room_eye,
            .target = open_room_target};
}

ChangeCase rooms25(const std::string& name, std::vector<Edit> before,
                   std::vector<std::vector<Edit>> changes) {
    return {.name = name,
            .file = "r25.gltf",
            .before = std::move(before),
            .changes = std::move(changes),
            .eye = {0.3F, 1.6F, 0.3F},
            .target = {4.0F, 0.8F, 4.0F},
            .field_of_view = 85.0F};
}

ChangeCase window(const std::string& name, const std::string& file, const glm::vec3& curtain) {
    return {.name = name,
            .file = file,
            .before = {},
            .changes = {{move_to("curtain", curtain)}},
            .eye = {2.5F, 1.6F, 0.4F},
            .target = {2.5F, 1.0F, 5.0F}};
}

ChangeCase built(const std::string& name, Scene (*build)(), std::vector<std::vector<Edit>> changes,
                 const glm::vec3& eye, const glm::vec3& target) {
    return {.name = name,
            .file = "",
            .build = build,
            .before = {},
            .changes = std::move(changes),
            .eye = eye,
            .target = target,
            .field_of_view = 85.0F};
}

ChangeCase pair_of_rooms(const std::string& name, bool second, std::vector<Edit> before,
                         std::vector<std::vector<Edit>> changes) {
    const float x = second ? 10.0F : 0.0F;
    ChangeCase c =
        built(name, two_rooms, std::move(changes), {x + 0.3F, 1.6F, 0.3F}, {x + 4.0F, 0.8F, 4.0F});
    c.before = std::move(before);
    return c;
}

ChangeCase furnished(const std::string& name, std::vector<std::vector<Edit>> changes) {
    return built(name, furnished_room, std::move(changes), {0.4F, 1.7F, 0.4F}, {6.0F, 0.6F, 6.0F});
}

/// One looks at the second room, or at the first.
ChangeCase opening(const std::string& name, bool second, std::vector<std::vector<Edit>> changes) {
    const float z = second ? 8.0F : 0.2F;
    return built(name, rooms_with_opening, std::move(changes), {3.7F, 1.6F, z},
                 {0.8F, 0.7F, second ? 4.3F : 3.8F});
}

/// Thirty small things, each of which has been moved by so much.
std::vector<Edit> thirty_moved(const Scene& scene, const glm::vec3& by) {
    std::vector<Edit> edits;
    for (int i = 0; i < 30; ++i) {
        const std::string name = "thing" + std::to_string(i);
        for (const Object& object : scene.objects) {
            if (object.name == name) {
                edits.push_back(move_to(name, object.transform.translation + by));
            }
        }
    }
    return edits;
}

std::vector<ChangeCase> cases_of_furniture() {
    const Scene scene = furnished_room();
    const std::vector<Edit> thirty = thirty_moved(scene, {0.3F, 0.6F, 0.2F});
    const std::vector<Edit> back = thirty_moved(scene, glm::vec3(0.0F));
    const glm::vec3 here(3.0F, 0.8F, 2.5F);
    ChangeCase grows = furnished("thing_grows", {{move_to("thing", here, 1.0F)}});
    grows.before = {move_to("thing", here, 1e-3F)};
    return {furnished("thirty_move", {thirty}),
            furnished("thirty_move_and_back", {thirty, back}),
            grows,
            furnished("thing_moves", {{move_to("thing", here + glm::vec3(0.3F, 0.0F, 0.2F))}}),
            furnished("thing_shrinks", {{move_to("thing", here, 1e-3F)}}),
            furnished("thing_goes_far", {{move_to("thing", {500.0F, 0.8F, 2.5F})}}),
            furnished("thing_comes_back",
                      {{move_to("thing", {500.0F, 0.8F, 2.5F})}, {move_to("thing", here)}})};
}

std::vector<ChangeCase> cases_of_surfaces() {
    const auto walls = [](const std::string& name, std::vector<std::vector<Edit>> changes) {
        return furnished(name, std::move(changes));
    };
    const auto lamp = [](float luminance) { return set_light("lamp0", luminance); };
    Edit metal = paint("wall", 0.7F);
    metal.metallic = 1.0F;
    Edit red = lamp(1000.0F);
    red.colour = glm::vec3(1.0F, 0.02F, 0.02F);
    Edit turned = move_to("mirror", {2.5F, 1.4F, 2.5F});
    turned.turn = 55.0F;
    ChangeCase extremes = walls("lamp_of_all_sizes", {{lamp(0.1F)}, {lamp(1e7F)}, {lamp(1000.0F)}});
    extremes.between = 40;
    ChangeCase black =
        walls("walls_black_and_back", {{paint("wall", 0.02F)}, {paint("wall", 0.7F)}});
    black.between = 100;
    ChangeCase off = walls("lamp_off_and_on", {{lamp(0.0F)}, {lamp(1000.0F)}});
    off.between = 100;
    return {extremes,
            black,
            off,
            walls("walls_black", {{paint("wall", 0.02F)}}),
            walls("lamp_red", {{red}}),
            built("walls_metal", plastic_room, {{metal}}, {0.3F, 1.6F, 0.3F}, {4.0F, 0.8F, 4.0F}),
            built("mirror_turns", room_with_mirror, {{turned}}, {4.7F, 1.6F, 0.3F},
                  {1.5F, 0.9F, 4.5F})};
}

std::vector<ChangeCase> cases_of_openings() {
    const Edit clear = move_to("clear", glm::vec3(0.0F));
    const Edit dark = move_to("dark", glm::vec3(0.0F));
    const Edit over = move_to("lamp", {0.0F, 0.0F, 4.1F});
    const Edit back = move_to("lamp", glm::vec3(0.0F));
    const Edit hood = move_to("hood", glm::vec3(0.0F));
    const Edit hood_off = move_to("hood", {0.0F, -12.0F, 0.0F});
    ChangeCase unhooded = pair_of_rooms("hood_off_lamp", false, {hood}, {{hood_off}});
    ChangeCase beside = pair_of_rooms("hood_next_door", true, {}, {{hood}});
    return {opening("clear_pane", true, {{clear}}),
            opening("dark_pane", true, {{dark}}),
            opening("lamp_to_other_room_dark", false, {{over}}),
            opening("lamp_to_other_room_bright", true, {{over}}),
            opening("lamp_to_other_room_and_back", false, {{over}, {back}}),
            pair_of_rooms("hood_over_lamp", false, {}, {{hood}}),
            unhooded,
            beside};
}

}  // namespace

Edit move_to(const std::string& object, const glm::vec3& translation, float scale) {
    return {.kind = Edit::Kind::move, .name = object, .value = translation, .scale = scale};
}

Edit shift_by(const std::string& object, const glm::vec3& by) {
    return {.kind = Edit::Kind::shift, .name = object, .value = by};
}

Edit set_light(const std::string& light, float luminance) {
    return {.kind = Edit::Kind::light, .name = light, .luminance = luminance};
}

Edit paint(const std::string& material, float albedo) {
    return {.kind = Edit::Kind::material, .name = material, .value = glm::vec3(albedo)};
}

std::vector<ChangeCase> change_cases() {
    const std::vector<Edit> first_bright = {set_light("lamp0", 5000.0F), set_light("lamp1", 50.0F)};
    const std::vector<Edit> second_bright = {set_light("lamp0", 50.0F),
                                             set_light("lamp1", 5000.0F)};
    const Edit lamp_out = move_to("lamp", {0.0F, 0.0F, -6.0F});
    const Edit lamp_in = move_to("lamp", {0.0F, 0.0F, 0.0F});
    const Edit door_away = move_to("door", {0.0F, 0.0F, -12.0F});
    const Edit door_shut = move_to("door", {0.0F, 0.0F, -0.06F});
    std::vector<std::vector<Edit>> sliding;
    for (int step = 1; step <= 40; ++step) {
        sliding.push_back(
            {move_to("door", {4.0F - 0.1F * static_cast<float>(step), 0.0F, -0.06F})});
    }
    std::vector<ChangeCase> cases = {
        open_room("lamp_out", "lampin.gltf", {{lamp_out}}),
        open_room("lamp_in", "lampout.gltf", {{lamp_in}}),
        open_room("lamp_out_and_in", "lampin.gltf", {{lamp_out}, {lamp_in}}),
        open_room("door_opens", "door_closed.gltf", {{door_away}}),
        open_room("door_closes", "door_open.gltf", {{door_shut}}),
        open_room("door_slides_shut", "door_open.gltf", sliding),
        window("curtain_closes", "win_open.gltf", {1.45F, 0.7F, -0.26F}),
        window("curtain_opens", "win_shut.gltf", {-3.0F, 0.7F, -0.26F}),
        rooms25("lamp_of_25_off", {}, {{set_light("lamp00", 0.0F)}}),
        rooms25("lamp_of_25_on", {set_light("lamp00", 0.0F)}, {{set_light("lamp00", 1000.0F)}}),
        rooms25("lamp_of_25_dimmed", {}, {{set_light("lamp00", 100.0F)}}),
        rooms25("walls_of_25_dark", {}, {{paint("wall00", 0.1F)}}),
        rooms25("walls_of_25_bright", {paint("wall00", 0.1F)}, {{paint("wall00", 0.7F)}}),
        pair_of_rooms("swap_gets_dark", false, first_bright,
                      {{set_light("lamp0", 50.0F), set_light("lamp1", 5000.0F)}}),
        pair_of_rooms("swap_gets_bright", true, first_bright,
                      {{set_light("lamp0", 50.0F), set_light("lamp1", 5000.0F)}}),
        pair_of_rooms("next_door_dimmed", false, second_bright, {{set_light("lamp1", 2000.0F)}}),
        pair_of_rooms("next_door_off", false, second_bright, {{set_light("lamp1", 0.0F)}}),
    };
    for (const auto& more : {cases_of_furniture(), cases_of_surfaces(), cases_of_openings()}) {
        cases.insert(cases.end(), more.begin(), more.end());
    }
    for (ChangeCase& c : cases) {
        if (c.name == "swap_gets_dark" || c.name == "swap_gets_bright") {
            c.bright = 600.0;
        }
        if (c.name == "next_door_dimmed" || c.name == "next_door_off") {
            c.bright = 6.0;
        }
        if (c.name == "lamp_out_and_in") {
            c.between = 300;
        }
        if (c.name == "door_slides_shut") {
            c.before = {move_to("door", {4.0F, 0.0F, -0.06F})};
        }
    }
    return cases;
}

const ChangeCase& change_case(const std::string& name) {
    static const std::vector<ChangeCase> cases = change_cases();
    for (const ChangeCase& c : cases) {
        if (c.name == name) {
            return c;
        }
    }
    throw std::runtime_error("no case " + name);
}

}  // namespace raybundle
