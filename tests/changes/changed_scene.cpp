// SPDX-License-Identifier: Apache-2.0
#include "changed_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <stdexcept>

#include "oracle/scene_builder.h"
#include "scene/gltf_loader.h"
#include "scene/surface_edit.h"
#include "view/viewer_image.h"

namespace raybundle {

namespace {

constexpr unsigned picture = 96;  // pixels along an edge
constexpr unsigned grid = 5;      // points along it

/// Two closed rooms of 4 m side by side, each with a lamp below its ceiling.
Scene two_rooms() {
    SceneBuilder b;
    const auto wall = b.add_material(glm::vec3(0.7F));
    for (const float x : {0.0F, 10.0F}) {
        const auto lamp = b.add_material(glm::vec3(0.5F), glm::vec3(1000.0F));
        b.add_object(x == 0.0F ? "first" : "second");
        b.add_box({x, 0, 0}, {x + 4, 4, 4}, true, 1, wall);
        b.add_quad({x + 1.5F, 3.9F, 1.5F}, {1, 0, 0}, {0, 0, 1}, 1, 1, lamp);
    }
    return b.loaded_scene();
}

Scene load(const ChangeCase& c) {
    if (c.file.empty()) {
        Scene scene = two_rooms();
        for (std::size_t i = 0; i < scene.lights.size(); ++i) {
            scene.lights[i].name = "lamp" + std::to_string(i);
        }
        return scene;
    }
    return load_gltf(std::string(RAYBUNDLE_CASES) + "/changes/" + c.file, SceneSettings{});
}

template <typename Range>
std::uint32_t index_of(const Range& things, const std::string& name) {
    for (std::size_t i = 0; i < things.size(); ++i) {
        if (things[i].name == name) {
            return static_cast<std::uint32_t>(i);
        }
    }
    throw std::runtime_error("no " + name);
}

LightEdit light_edit(const Scene& scene, const Edit& edit) {
    LightEdit light;
    light.light = scene.lights[index_of(scene.lights, edit.name)].id;
    light.on = edit.luminance > 0.0F;
    if (edit.luminance > 0.0F) {
        light.intensity = edit.luminance;
    }
    return light;
}

MaterialEdit material_edit(const Scene& scene, const Edit& edit) {
    MaterialEdit material;
    material.material = index_of(scene.materials, edit.name) + 1;
    material.base_colour = edit.value;
    return material;
}

void place(Scene& scene, const Edit& edit) {
    Object& object = scene.objects[index_of(scene.objects, edit.name)];
    object.transform.translation = edit.value;
    object.transform.scale = glm::vec3(edit.scale);
}

void make(Scene& scene, const std::vector<Edit>& edits) {
    for (const Edit& edit : edits) {
        switch (edit.kind) {
            case Edit::Kind::move:
                place(scene, edit);
                break;
            case Edit::Kind::light:
                apply(scene, light_edit(scene, edit));
                break;
            case Edit::Kind::material:
                apply(scene, material_edit(scene, edit));
                break;
        }
    }
}

SolverSettings settings_of(std::uint64_t seed) {
    SolverSettings settings;
    settings.seed = seed;
    settings.special = interactive_special();
    return settings;
}

/// A scene with a solver of it, and a picture.
class Watched {
  public:
    Watched(const ChangeCase& c, Scene scene, std::uint64_t seed)
        : scene_(std::move(scene)),
          mesh_(tessellate(scene_, {.patch_size = c.patch_size})),
          solver_(scene_, mesh_, settings_of(seed)),
          programs_(solver_.scene()),
          image_(solver_.scene(), solver_.store(), programs_, glm::uvec2(picture)) {
        Camera camera;
        camera.eye = c.eye;
        camera.target = c.target;
        camera.vertical_fov = glm::radians(c.field_of_view);
        image_.set_camera(camera);
    }

    void iterate(std::uint64_t count) {
        const std::uint64_t end = solver_.iterations() + count;
        while (solver_.iterations() < end || !solver_.between_groups()) {
            solver_.step(receivers_);
        }
    }

    void change(const std::vector<Edit>& edits) {
        std::vector<ObjectMove> moves;
        std::vector<std::uint32_t> materials;
        std::vector<std::uint32_t> reflecting;
        for (const Edit& edit : edits) {
            if (edit.kind == Edit::Kind::move) {
                place(scene_, edit);
                const std::uint32_t object = index_of(scene_.objects, edit.name);
                moves.push_back({object, scene_.objects[object].world_from_object()});
            } else if (edit.kind == Edit::Kind::light) {
                materials.push_back(apply(scene_, light_edit(scene_, edit)));
            } else {
                materials.push_back(apply(scene_, material_edit(scene_, edit)));
                reflecting.push_back(materials.back());
            }
        }
        if (!moves.empty()) {
            solver_.move_objects(moves, receivers_);
        } else {
            solver_.change_surfaces(scene_, mesh_, materials, reflecting, receivers_);
        }
        while (solver_.correcting()) {
            solver_.step(receivers_);
        }
    }

    Served served(std::uint64_t iterations) {
        std::vector<glm::uvec2> pixels;
        for (unsigned i = 0; i < grid * grid; ++i) {
            const glm::uvec2 cell(i % grid, i / grid);
            pixels.push_back((2U * cell + 1U) * picture / (2 * grid));
        }
        image_.request_statistics();  // interpolates what the patches have
        image_.finish_statistics();
        Served result;
        result.stated_low = image_.statistics().error_low;
        result.stated_high = image_.statistics().error_high;
        result.iterations = iterations;
        for (const auto& probe : image_.probe(pixels)) {
            const double lux = probe ? static_cast<double>(luminance(probe->irradiance)) : 0.0;
            result.points.push_back(lux);
            result.mean += lux / (grid * grid);
        }
        result.settled = solver_.statistics().settled;
        return result;
    }

    std::vector<Served> follow(std::span<const std::uint64_t> at) {
        std::vector<Served> result;
        std::uint64_t done = 0;
        for (const std::uint64_t iterations : at) {
            iterate(iterations - done);
            done = iterations;
            result.push_back(served(iterations));
        }
        return result;
    }

  private:
    Scene scene_;
    PatchMesh mesh_;
    Solver solver_;
    ViewPrograms programs_;
    ViewerImage image_;
    BundleReceiver* const receivers_[1] = {&image_};
};

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

ChangeCase pair_of_rooms(const std::string& name, bool second, std::vector<Edit> before,
                         std::vector<std::vector<Edit>> changes) {
    const float x = second ? 10.0F : 0.0F;
    return {.name = name,
            .file = "",
            .before = std::move(before),
            .changes = std::move(changes),
            .eye = {x + 0.3F, 1.6F, 0.3F},
            .target = {x + 4.0F, 0.8F, 4.0F},
            .field_of_view = 85.0F};
}

}  // namespace

Edit move_to(const std::string& object, const glm::vec3& translation, float scale) {
    return {.kind = Edit::Kind::move, .name = object, .value = translation, .scale = scale};
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

std::vector<Served> solve_anew(const ChangeCase& c, std::uint64_t seed,
                               std::span<const std::uint64_t> at) {
    Scene scene = load(c);
    make(scene, c.before);
    for (const std::vector<Edit>& change : c.changes) {
        make(scene, change);
    }
    Watched watched(c, std::move(scene), seed);
    return watched.follow(at);
}

std::vector<Served> change_and_solve(const ChangeCase& c, std::uint64_t seed,
                                     std::uint64_t iterations_before,
                                     std::span<const std::uint64_t> at) {
    Scene scene = load(c);
    make(scene, c.before);
    Watched watched(c, std::move(scene), seed);
    watched.iterate(iterations_before);
    for (std::size_t i = 0; i < c.changes.size(); ++i) {
        watched.change(c.changes[i]);
        if (i + 1 < c.changes.size()) {
            watched.iterate(c.between);
        }
    }
    return watched.follow(at);
}

double error_of(const Served& served, std::span<const double> truth, double scale) {
    double sum = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        const double difference = served.points[i] - truth[i];
        sum += difference * difference;
        size += truth[i] * truth[i];
    }
    const auto count = static_cast<double>(truth.size());
    return std::sqrt(sum / count) / std::max(std::sqrt(size / count), scale);
}

}  // namespace raybundle
