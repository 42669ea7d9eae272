// SPDX-License-Identifier: Apache-2.0
#include "scene/edit/luminaire_edit.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "scene/edit/light_edit.h"
#include "scene/gltf/gltf_loader.h"
#include "scene/light/light_place.h"
#include "scene/object_limits.h"
#include "scene/scene_folder.h"

namespace raybundle {
namespace {

std::string file_problem(const Scene& scene, const std::string& photometry) {
    if (!scene.folder) {
        return "this server has no folder of scenes, so it has no photometric files";
    }
    try {
        const auto profile = scene.folder->photometry(photometry);
        return profile->flux() > 0.0 ? "" : fmt::format("'{}' is dark", photometry);
    } catch (const SceneError& error) {
        return error.what();
    }
}

/// Whether a name stands for the distribution that a light was loaded or added with.
bool is_own(const PunctualLight& light, const std::string& photometry) {
    return photometry.empty() ||
           photometry == (light.as_loaded ? light.as_loaded->photometry : light.photometry);
}

}  // namespace

std::string problem_of(const Scene& scene, const AddedLuminaire& luminaire) {
    if (const std::string problem = file_problem(scene, luminaire.photometry); !problem.empty()) {
        return "photometry: " + problem;
    }
    const double limit = farthest_place(scene);
    const glm::dvec3 far = glm::abs(glm::dvec3(luminaire.position));
    if (std::max({far.x, far.y, far.z}) > limit) {
        return fmt::format("position: may be {:.0f} m away from zero at most", limit);
    }
    return "";
}

void add_luminaire(Scene& scene, const AddedLuminaire& luminaire) {
    if (punctual_index(scene, luminaire.number)) {
        set_light_removed(scene, luminaire.number, false);
        return;
    }
    PunctualLight light;
    light.name = luminaire.name;
    light.intensity = glm::vec3(1.0F);
    light.profile = scene.folder->photometry(luminaire.photometry);
    light.photometry = luminaire.photometry;
    light.control.group = luminaire.group;
    light.added = std::make_shared<const AddedLuminaire>(luminaire);
    set_place({luminaire.position, glm::normalize(luminaire.aim), luminaire.rotation}, light);
    scene.punctual_lights.push_back(std::move(light));
}

std::uint32_t next_luminaire(const Scene& scene) {
    std::uint32_t next = first_added_light;
    for (const PunctualLight& light : scene.punctual_lights) {
        next = light.added ? std::max(next, light.added->number + 1) : next;
    }
    return next;
}

std::size_t added_lights(const Scene& scene) {
    return static_cast<std::size_t>(
        std::count_if(scene.punctual_lights.begin(), scene.punctual_lights.end(),
                      [](const PunctualLight& light) { return light.added != nullptr; }));
}

std::string removal_problem(const Scene& scene, std::uint32_t light) {
    const auto index = punctual_index(scene, light);
    if (!index) {
        return has_light(scene, light)
                   ? fmt::format(
                         "light {} is the sky or a surface: switch it off, or remove its object",
                         light)
                   : fmt::format("no light {}", light);
    }
    if (scene.punctual_lights[*index].of_sky) {
        return fmt::format("light {} is the sun: choose another sky", light);
    }
    return scene.punctual_lights[*index].removed ? fmt::format("no light {}", light) : "";
}

void set_light_removed(Scene& scene, std::uint32_t light, bool removed) {
    if (const auto index = punctual_index(scene, light)) {
        scene.punctual_lights[*index].removed = removed;
        refresh_intensity(scene.punctual_lights[*index]);
    }
}

std::string exchange_problem(const Scene& scene, const PunctualLight& light,
                             const std::string& photometry) {
    if (light.of_sky || light.kind == PunctualKind::directional) {
        return photometry.empty() ? "" : "a directional light shines by no photometric file";
    }
    return photometry == light.photometry || is_own(light, photometry)
               ? ""
               : file_problem(scene, photometry);
}

void exchange_photometry(const Scene& scene, PunctualLight& light, const std::string& photometry) {
    const bool own = is_own(light, photometry);
    if (own ? !light.as_loaded : light.as_loaded && photometry == light.photometry) {
        return;
    }
    if (!light.as_loaded) {
        light.as_loaded = std::make_shared<const PunctualLight>(light);
    }
    const std::shared_ptr<const PunctualLight> loaded = light.as_loaded;
    PunctualSetting setting = setting_of(light);
    if (own) {
        light.kind = loaded->kind;
        light.profile = loaded->profile;
        light.photometry = loaded->photometry;
        light.inner_cosine = loaded->inner_cosine;
        light.outer_cosine = loaded->outer_cosine;
        setting.loaded = setting_of(*loaded).loaded;
        light.as_loaded = nullptr;
    } else {
        light.kind = PunctualKind::point;
        light.profile = scene.folder->photometry(photometry);
        light.photometry = photometry;
        light.inner_cosine = 1.0F;
        light.outer_cosine = 0.0F;
        setting.loaded = glm::vec3(1.0F);
    }
    setting.intensity = luminance(setting.loaded) * setting.colour;
    light.setting = setting;
    refresh_intensity(light);
}

}  // namespace raybundle
