// SPDX-License-Identifier: Apache-2.0
#include "changed_scene.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <stdexcept>

#include "scene/edit/surface_edit.h"
#include "scene/gltf/gltf_loader.h"

namespace raybundle {

namespace {

constexpr unsigned grid = 5;  // points along an edge of the picture

Scene load(const ChangeCase& c) {
    if (c.build != nullptr) {
        return c.build();
    }
    const auto folder = std::filesystem::path(RAYBUNDLE_CASES) / "changes";
    return load_gltf((folder / c.file).string(), SceneSettings{});
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
    light.colour = edit.colour;
    return light;
}

MaterialEdit material_edit(const Scene& scene, const Edit& edit) {
    MaterialEdit material;
    material.material = index_of(scene.materials, edit.name) + 1;
    material.base_colour = edit.value;
    material.metallic = edit.metallic;
    return material;
}

void place(Scene& scene, const Edit& edit) {
    Object& object = scene.objects[index_of(scene.objects, edit.name)];
    if (edit.kind == Edit::Kind::shift) {
        object.transform.translation += edit.value;
        return;
    }
    object.transform.translation = edit.value;
    object.transform.scale = glm::vec3(edit.scale);
    object.transform.rotation = glm::angleAxis(glm::radians(edit.turn), glm::vec3(0, 1, 0));
}

void make(Scene& scene, const std::vector<Edit>& edits) {
    for (const Edit& edit : edits) {
        switch (edit.kind) {
            case Edit::Kind::move:
            case Edit::Kind::shift:
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

SolverSettings settings_of(const ChangeCase& c, std::uint64_t seed) {
    SolverSettings settings;
    settings.seed = seed;
    settings.coarse = c.coarse;
    settings.special = interactive_special();
    return settings;
}

/// A scene with a solver of it, and a picture.
class Watched {
  public:
    Watched(const ChangeCase& c, Scene scene, std::uint64_t seed)
        : scene_(std::move(scene)),
          mesh_(tessellate(scene_, {.patch_size = c.patch_size})),
          solver_(scene_, mesh_, settings_of(c, seed)),
          programs_(solver_.scene()),
          image_(solver_.scene(), solver_.store(), programs_, glm::uvec2(c.picture)) {
        image_.set_camera(camera_of(c));
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
            if (edit.kind == Edit::Kind::move || edit.kind == Edit::Kind::shift) {
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
        for (std::size_t first = 0; first < moves.size(); first += MOST_MOVED) {
            const std::size_t count = std::min<std::size_t>(moves.size() - first, MOST_MOVED);
            solver_.move_objects(std::span(moves).subspan(first, count), receivers_);
            correct();
        }
        if (!materials.empty()) {
            solver_.change_surfaces(scene_, mesh_, materials, reflecting, receivers_);
            correct();
        }
    }

    Served served(std::uint64_t iterations) {
        const unsigned picture = image_.size().x;
        std::vector<glm::uvec2> pixels;
        for (unsigned i = 0; i < grid * grid; ++i) {
            const glm::uvec2 cell(i % grid, i / grid);
            pixels.push_back((2U * cell + 1U) * picture / (2 * grid));
        }
        image_.smooth();
        state();
        Served result;
        result.stated = image_.statistics();
        result.radiance = image_.read_radiance();
        result.iterations = iterations;
        for (const auto& probe : image_.probe(pixels)) {
            const double lux = probe ? static_cast<double>(luminance(probe->irradiance)) : 0.0;
            result.points.push_back(lux);
            result.mean += lux / (grid * grid);
        }
        result.settled = solver_.statistics().settled;
        return result;
    }

    /// The same, while the picture states its error every so many, as viewers are told all the
    /// time.
    void run(std::uint64_t count) {
        constexpr std::uint64_t interval = 16;
        while (count > 0) {
            const std::uint64_t next = std::min(count, interval);
            iterate(next);
            state();
            count -= next;
        }
    }

    std::vector<Served> follow(std::span<const std::uint64_t> at) {
        std::vector<Served> result;
        std::uint64_t done = 0;
        for (const std::uint64_t iterations : at) {
            run(iterations - done);
            done = iterations;
            result.push_back(served(iterations));
        }
        return result;
    }

  private:
    void state() {
        image_.request_statistics();  // interpolates what the patches have
        image_.finish_statistics();
    }

    void correct() {
        while (solver_.correcting()) {
            solver_.step(receivers_);
        }
    }

    Scene scene_;
    PatchMesh mesh_;
    Solver solver_;
    ViewPrograms programs_;
    ViewerImage image_;
    BundleReceiver* const receivers_[1] = {&image_};
};

}  // namespace

Scene last_scene(const ChangeCase& c) {
    Scene scene = load(c);
    make(scene, c.before);
    for (const std::vector<Edit>& change : c.changes) {
        make(scene, change);
    }
    return scene;
}

Camera camera_of(const ChangeCase& c) {
    Camera camera;
    camera.eye = c.eye;
    camera.target = c.target;
    camera.vertical_fov = glm::radians(c.field_of_view);
    return camera;
}

std::vector<Served> solve_anew(const ChangeCase& c, std::uint64_t seed,
                               std::span<const std::uint64_t> at) {
    Watched watched(c, last_scene(c), seed);
    return watched.follow(at);
}

std::vector<Served> change_and_solve(const ChangeCase& c, std::uint64_t seed,
                                     std::uint64_t iterations_before,
                                     std::span<const std::uint64_t> at) {
    Scene scene = load(c);
    make(scene, c.before);
    Watched watched(c, std::move(scene), seed);
    watched.run(iterations_before);
    for (std::size_t i = 0; i < c.changes.size(); ++i) {
        watched.change(c.changes[i]);
        if (i + 1 < c.changes.size()) {
            watched.run(c.between);
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
