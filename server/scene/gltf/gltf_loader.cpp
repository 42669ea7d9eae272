// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_loader.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <new>
#include <utility>

#include "scene/contact/solid_shells.h"
#include "scene/gltf/animation/animation_links.h"
#include "scene/gltf/animation/shape_links.h"
#include "scene/gltf/file/gltf_bake.h"
#include "scene/gltf/file/gltf_container.h"
#include "scene/gltf/file/gltf_document.h"
#include "scene/gltf/gltf_camera.h"
#include "scene/gltf/gltf_lights.h"
#include "scene/gltf/gltf_node_tree.h"
#include "scene/gltf/gltf_objects.h"
#include "scene/gltf/gltf_place.h"
#include "scene/gltf/gltf_primitive.h"
#include "scene/gltf/lone_object.h"
#include "scene/gltf/material/gltf_material.h"
#include "scene/gltf/saved/saved_lighting.h"
#include "scene/gltf/saved/saved_state.h"
#include "scene/gltf/saved/scene_source.h"
#include "scene/light/environment.h"
#include "scene/light/lights.h"
#include "scene/material/specular_surface.h"
#include "scene/mesh/geometry_defects.h"
#include "scene/walk/default_camera.h"

namespace raybundle {
namespace {

/// glTF's default material is only kept where a triangle uses it, or as the only one.
void drop_unused_default_material(Scene& scene, std::uint32_t default_material) {
    for (const Triangle& triangle : scene.triangles) {
        if (triangle.material == default_material) {
            return;
        }
    }
    if (scene.materials.size() > 1) {
        scene.materials.pop_back();
    }
}

void name_materials(Scene& scene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        if (scene.materials[i].name.empty()) {
            scene.materials[i].name = fmt::format("material {}", i + 1);
        }
    }
}

/// Gives the punctual lights of a name the distribution of a file, "LIGHT=FILE"; their colour
/// stays.
void apply_ies(const std::string& choice, GltfDocument& document, Scene& scene) {
    const std::size_t equals = choice.find('=');
    const std::string name = choice.substr(0, equals);
    const std::string file = choice.substr(equals + 1);
    std::shared_ptr<const IesProfile> profile;
    std::string names;
    for (PunctualLight& light : scene.punctual_lights) {
        names += (names.empty() ? "'" : ", '") + light.name + "'";
        if (light.name != name || light.kind == PunctualKind::directional) {
            continue;
        }
        if (!profile) {
            profile = std::make_shared<const IesProfile>(read_photometry(file));
        }
        light.kind = PunctualKind::point;
        light.intensity = colour_of(light);
        light.profile = profile;
    }
    if (profile) {
        for (const std::string& note : profile->data().notes) {
            document.note(fmt::format("photometry '{}': {}", file, note));
        }
    } else {
        throw SceneError(scene.path, "",
                         fmt::format("--ies: there is no point light or spot '{}'; punctual "
                                     "lights: {}",
                                     name, names.empty() ? "none" : names));
    }
}

/// Names the options of a sky or of an image that the scene does not have.
void note_unused_daylight(GltfDocument& document, const Daylight& options, bool sky,
                          bool environment) {
    std::string names;
    const auto add = [&](const char* name, bool given, bool used) {
        if (given && !used) {
            names += (names.empty() ? "" : ", ") + std::string(name);
        }
    };
    add("skyZenith", options.zenith_luminance.has_value(), sky);
    add("sunElevation", options.sun_elevation.has_value(), sky);
    add("sunAzimuth", options.sun_azimuth.has_value(), sky);
    add("sunIlluminance", options.sun_illuminance.has_value(), sky);
    add("sunDiameter", options.sun_diameter.has_value(), sky);
    add("groundAlbedo", options.ground_albedo.has_value(), sky);
    if (!names.empty()) {
        document.note("no effect: " + names + ". The scene has no standard sky (--sky clear)");
    }
    names.clear();
    add("environmentRotation", options.environment_rotation.has_value(), environment);
    add("environmentScale", options.environment_scale.has_value(), environment);
    if (!names.empty()) {
        document.note("no effect: " + names + ". The scene has no image of its surroundings");
    }
}

void set_sky(GltfDocument& document, const SceneSettings& settings, Scene& scene) {
    scene.medium = document.air();
    const Daylight daylight = overlaid(document.daylight(), settings.daylight);
    const bool uniform = settings.sky_luminance.has_value();
    note_unused_daylight(document, settings.daylight,
                         !uniform && daylight.sky && !daylight.environment,
                         !uniform && daylight.environment);
    if (settings.sky_luminance) {
        scene.sky_radiance = glm::vec3(*settings.sky_luminance);
    } else if (daylight.given()) {
        apply_daylight(daylight, scene);
    } else if (const auto saved = saved_sky_luminance(document.saved())) {
        scene.sky_radiance = glm::vec3(*saved);
    } else if (!has_emitter(scene)) {
        scene.sky_radiance = glm::vec3(settings.default_sky_luminance);
        document.note(
            fmt::format("nothing in the scene emits light: it is lit by a uniform sky "
                        "of {} cd/m²",
                        settings.default_sky_luminance));
    }
}

/// Names the materials whose reflections are nearly mirror images that view rays do not show:
/// bundles find those slowly.
void note_materials(GltfDocument& document, const Scene& scene) {
    std::vector<bool> used(scene.materials.size(), false);
    for (const Triangle& triangle : scene.triangles) {
        used[triangle.material] = true;
    }
    std::string names;
    for (std::size_t i = 0; i < used.size(); ++i) {
        const Material& m = scene.materials[i];
        const bool lamp = m.emission != glm::vec3(0.0F);
        if (used[i] && !lamp && has_smooth_lobe(m) && specular_kind(m) == SpecularKind::none) {
            names += (names.empty() ? "'" : ", '") + m.name + "'";
        }
    }
    if (!names.empty()) {
        document.note(fmt::format("nearly mirrors, their reflections settle slowly: {}", names));
    }
}

/// See SceneSource::entangled. plans: of the objects, which more than one may share.
std::vector<bool> find_entangled(const GltfDocument& document, const GltfNodeTree& tree,
                                 const std::vector<LightSource>& light_sources,
                                 const Scene& scene) {
    constexpr int nobody = -1;
    std::vector<int> owner(tree.nodes.size(), nobody);  // object whose node is the nearest above
    std::vector<bool> entangled(scene.objects.size(), false);
    for (const Object& object : scene.objects) {
        int& first = owner[static_cast<std::size_t>(object.node)];
        first = first == nobody ? static_cast<int>(object.id) - 1 : first;
    }
    const auto mark_above = [&](int node) {
        for (; node >= 0; node = tree.nodes[static_cast<std::size_t>(node)].parent) {
            if (const int object = owner[static_cast<std::size_t>(node)]; object != nobody) {
                entangled[static_cast<std::size_t>(object)] = true;
            }
        }
    };
    for (const int index : tree.order) {
        const tinygltf::Node& node = item(document.model().nodes, index);
        const int parent = tree.nodes[static_cast<std::size_t>(index)].parent;
        mark_above(node.camera >= 0 || node.skin >= 0                 ? index
                   : owner[static_cast<std::size_t>(index)] != nobody ? parent
                                                                      : -1);
    }
    for (std::size_t i = 0; i < light_sources.size(); ++i) {
        if (scene.punctual_lights[i].object == PunctualLight::no_object) {
            mark_above(static_cast<int>(light_sources[i].node));
        }
    }
    return entangled;
}

/// What saving the scene needs to know of how it was read.
std::shared_ptr<const SceneSource> source_of(const GltfDocument& document, const GltfNodeTree& tree,
                                             const SceneSettings& settings, const FileMark& mark,
                                             const std::vector<LightSource>& light_sources,
                                             const Scene& scene) {
    SceneSource source;
    source.file = mark;
    source.metres_per_unit = settings.metres_per_unit;
    source.ies = settings.ies;
    if (!settings.sky_luminance) {
        source.daylight = overlaid(document.daylight(), settings.daylight);
    }
    source.sky_luminance = source.daylight.given() ? 0.0F : scene.sky_radiance.g;
    source.materials = scene.materials;
    for (const Object& object : scene.objects) {
        source.transforms.push_back(object.transform);
    }
    source.lights.assign(
        scene.punctual_lights.begin(),
        scene.punctual_lights.begin() + static_cast<std::ptrdiff_t>(light_sources.size()));
    source.light_sources = light_sources;
    source.entangled = find_entangled(document, tree, light_sources, scene);
    return std::make_shared<const SceneSource>(std::move(source));
}

Scene load_checked(GltfDocument& document, SceneSettings settings, const FileMark& mark) {
    const float saved_unit = saved_metres_per_unit(document.saved());
    settings.metres_per_unit =
        settings.metres_per_unit == 1.0F ? saved_unit : settings.metres_per_unit;
    Scene scene;
    scene.path = document.path();
    scene.name = std::filesystem::path(scene.path).stem().string();
    GltfNodeTree tree = read_node_tree(document, settings.metres_per_unit);
    const std::uint32_t default_material = read_materials(document, scene);
    for (Material& material : scene.materials) {
        material.thickness *= settings.metres_per_unit;
        material.attenuation_distance *= settings.metres_per_unit;
    }
    check_meshes(document);
    const std::vector<NodeGeometry> geometries =
        read_placed_geometry(document, tree, settings.metres_per_unit, scene);
    const FileAnimations animations = read_animations(document, tree);
    std::vector<ObjectPlan> plans = plan_objects(document, tree, geometries, animations.moved);
    const std::vector<BakedPrimitive> baked =
        bake_objects(document, tree, geometries, plans, default_material,
                     find_deforming(document, tree, geometries, animations), scene);
    const std::vector<LightSource> light_sources =
        read_punctual_lights(document, tree, plans, animations.moved, scene);
    for (const std::string& choice : settings.ies) {
        apply_ies(choice, document, scene);
    }
    scene.removed.duplicate_faces = remove_duplicate_faces(scene);
    if (scene.removed.duplicate_faces > 0) {
        document.note(
            fmt::format("{} duplicate faces are left out", scene.removed.duplicate_faces));
    }
    drop_unused_default_material(scene, default_material);
    scene.lights = find_lights(scene);
    name_materials(scene);
    const bool whole = plans.front().whole;
    if (!whole && split_lone_object(scene) > 1 && plans.size() == 1) {
        document.note(fmt::format("the only object is divided into {} connected parts",
                                  scene.objects.size()));
    }
    if (const std::vector<std::string> open = thin_open_glass(scene); !open.empty()) {
        const std::string more =
            open.size() > 1 ? fmt::format(" and {} more", open.size() - 1) : std::string();
        document.note(
            fmt::format("material '{}'{}: it has a thickness, but its surfaces do not close: they "
                        "are read as thin panes",
                        open.front(), more));
    }
    scene.cameras = read_cameras(document, tree, scene.bounds);
    scene.removed.solid_insides = mark_solid_shells(scene);
    measure_lights(scene);
    link_animations(document, animations,
                    {tree, settings.metres_per_unit, geometries, plans, light_sources, baked},
                    scene);
    note_materials(document, scene);
    restore_area_lights(document.saved(), scene);
    set_sky(document, settings, scene);
    scene.sky_light = find_sky_light(scene);
    scene.source = source_of(document, tree, settings, mark, light_sources, scene);
    restore_daylight(document.saved(), scene);
    scene.lighting_scenes = saved_lighting_scenes(document.saved(), light_sources, scene);
    if (scene.cameras.empty()) {
        scene.cameras = default_cameras(scene);
        document.note("the file has no usable camera: default ones are used");
    }
    scene.notices.insert(scene.notices.begin(), document.notices().begin(),
                         document.notices().end());
    return scene;
}

/// read: gives the container.
template <typename Read>
Scene load(const std::string& path, const SceneSettings& settings, const Read& read) {
    try {
        GltfContainer container = read();
        const FileMark mark = container.mark;
        GltfDocument document(path, std::move(container));
        return load_checked(document, settings, mark);
    } catch (const std::bad_alloc&) {
        throw SceneError(path, "", "not enough memory to load the scene");
    } catch (const std::length_error& error) {
        throw SceneError(path, "", fmt::format("too large: {}", error.what()));
    }
}

}  // namespace

Scene load_gltf(const std::string& path, const SceneSettings& settings) {
    return load(path, settings, [&] { return read_gltf_container(path); });
}

Scene load_gltf(const std::string& path, std::span<const std::uint8_t> bytes,
                const SceneSettings& settings) {
    return load(path, settings, [&] { return parse_gltf_container(path, bytes); });
}

}  // namespace raybundle
