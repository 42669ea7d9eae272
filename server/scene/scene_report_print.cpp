// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <ostream>

#include "scene/scene_report.h"
#include "scene/significant.h"

#include "scene/animation/scene_animations.h"
#include "scene/light/environment.h"
#include "scene/light/light_figures.h"

namespace raybundle {
namespace {

using Json = nlohmann::json;

std::string text_of(const glm::vec3& v) {
    return fmt::format("{}, {}, {}", significant(v.x, 4), significant(v.y, 4), significant(v.z, 4));
}

Json json_of(const glm::vec3& v) {
    return {{"x", v.x}, {"y", v.y}, {"z", v.z}};
}

Json json_of(const Bounds& bounds) {
    return {{"min", json_of(bounds.min)}, {"max", json_of(bounds.max)}};
}

const char* name_of(AlphaMode mode) {
    return mode == AlphaMode::mask ? "MASK" : "OPAQUE";
}

void print_summary(std::ostream& out, const Scene& scene, const SceneReport& report) {
    out << fmt::format("{} ({})\n", scene.name, scene.path);
    out << fmt::format("bounds      {}  to  {}  ({} m)\n", text_of(scene.bounds.min),
                       text_of(scene.bounds.max), text_of(scene.bounds.extent()));
    if (scene.origin != glm::dvec3(0.0)) {
        out << fmt::format("origin      {:.0f}, {:.0f}, {:.0f} m of the file's coordinates\n",
                           scene.origin.x, scene.origin.y, scene.origin.z);
    }
    if (report.unit_hint) {
        out << fmt::format("unit        {}\n", *report.unit_hint);
    }
    out << fmt::format("file        {} triangles, {} vertices, {} m²\n", scene.triangles.size(),
                       report.referenced_vertices, significant(report.area, 4));
    out << fmt::format("patches     {} on {} triangles, {} vertices\n", report.patches,
                       report.patch_triangles, report.patch_vertices);
    if (report.joined_triangles > 0) {
        out << fmt::format("joined      {} triangles share {} patches\n", report.joined_triangles,
                           report.joined_patches);
    }
    out << fmt::format(
        "left out    {} triangles without area, {} duplicate faces, {} insides of "
        "solids\n",
        scene.removed.degenerate_triangles, scene.removed.duplicate_faces,
        scene.removed.solid_insides);
    out << fmt::format("edges       {} open, {} shared by more than two triangles\n",
                       report.edges.boundary, report.edges.non_manifold);
    for (const EnclosedLight& lamp : report.enclosed) {
        out << fmt::format("enclosed    '{}': '{}' encloses it, none of its light gets out\n",
                           lamp.light, lamp.object);
    }
    out << fmt::format("sky         {} cd/m²\n", text_of(scene.sky_radiance));
    if (scene.environment) {
        out << fmt::format("environment {}\n", scene.environment->description());
    }
}

const char* name_of(PunctualKind kind) {
    switch (kind) {
        case PunctualKind::spot:
            return "spot";
        case PunctualKind::directional:
            return "directional";
        case PunctualKind::point:
            break;
    }
    return "point";
}

/// "door, handle; 2 lights": the first objects by name.
std::string moved_by(const Scene& scene, const Animation& animation) {
    constexpr std::size_t most_named = 5;
    std::string text;
    for (std::size_t i = 0; i < std::min(animation.objects.size(), most_named); ++i) {
        text += (i == 0 ? "" : ", ") + scene.objects[animation.objects[i]].name;
    }
    if (animation.objects.size() > most_named) {
        text += fmt::format(" and {} more", animation.objects.size() - most_named);
    }
    const auto add = [&text](std::size_t count, const char* what) {
        if (count > 0) {
            text += fmt::format("{}{} {}{}", text.empty() ? "" : "; ", count, what,
                                count == 1 ? "" : "s");
        }
    };
    add(animation.lights.size(), "light");
    add(animation.materials.size(), "material");
    add(animation.shapes.size(), "deformed object");
    return text;
}

/// In the units that people know lights by.
std::string strength_of(const PunctualLight& light) {
    const LightFigures figures = loaded_figures(light);
    if (light.kind == PunctualKind::directional) {
        return fmt::format("{} lx  (RGB {})", significant(luminance(light.intensity), 4),
                           text_of(light.intensity));
    }
    if (!light.profile) {
        return fmt::format("{} cd, {} lm  (RGB {})", significant(figures.peak, 4),
                           significant(figures.flux, 4), text_of(light.intensity));
    }
    const std::string watts =
        figures.watts > 0.0 ? ", " + significant(figures.watts, 4) + " W" : std::string();
    return fmt::format("{} lm, at most {} cd{}", significant(figures.flux, 4),
                       significant(figures.peak, 4), watts);
}

void print_lists(std::ostream& out, const Scene& scene) {
    out << fmt::format("objects     {}\n", scene.objects.size());
    for (const Object& object : scene.objects) {
        out << fmt::format("  {:4} {}{}\n", object.id, object.name,
                           object.movable ? "  (movable)" : "");
    }
    out << fmt::format("materials   {}\n", scene.materials.size());
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        out << fmt::format("  {:4} {}  base colour {}{}{}\n", i + 1, material.name,
                           text_of(material.base_colour),
                           material.base_colour_texture.texture >= 0 ? " * texture" : "",
                           material.double_sided ? ", double sided" : "");
    }
    out << fmt::format("lights      {}\n", scene.lights.size() + scene.punctual_lights.size());
    for (const Light& light : scene.lights) {
        out << fmt::format("  {:4} {}  {} cd/m², {} lm  (RGB {})\n", light.id, light.name,
                           significant(luminance(light.radiance), 4),
                           significant(loaded_figures(light).flux, 4), text_of(light.radiance));
    }
    std::size_t id = scene.lights.size();
    for (const PunctualLight& light : scene.punctual_lights) {
        out << fmt::format("  {:4} {}  {}  {}\n", ++id, light.name, name_of(light.kind),
                           strength_of(light));
    }
    out << fmt::format("cameras     {}\n", scene.cameras.size());
    for (const Camera& camera : scene.cameras) {
        out << fmt::format("       {}  eye {}  target {}  vertical fov {:.4g} degrees\n",
                           camera.name, text_of(camera.eye), text_of(camera.target),
                           glm::degrees(camera.vertical_fov));
    }
    if (scene.animations) {
        out << fmt::format("animations  {}\n", scene.animations->animations.size());
        for (const Animation& animation : scene.animations->animations) {
            out << fmt::format("       {}  {:.4g} s  {}\n", animation.name, animation.seconds,
                               moved_by(scene, animation));
        }
    }
    out << fmt::format("textures    {}\n", scene.textures.size());
    for (const Texture& texture : scene.textures) {
        out << fmt::format("       {}  {} x {}\n", texture.name, texture.width, texture.height);
    }
    for (const std::string& notice : scene.notices) {
        out << fmt::format("notice      {}\n", notice);
    }
}

Json objects_json(const Scene& scene) {
    Json result = Json::array();
    for (const Object& object : scene.objects) {
        result.push_back({{"id", object.id},
                          {"name", object.name},
                          {"movable", object.movable},
                          {"bounds", json_of(object.bounds)}});
    }
    return result;
}

Json max_phong_json(const std::optional<MaxPhong>& lobe) {
    return lobe ? Json{{"specular", json_of(lobe->specular)}, {"exponent", lobe->exponent}}
                : Json(nullptr);
}

Json materials_json(const Scene& scene) {
    Json result = Json::array();
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        result.push_back({{"id", i + 1},
                          {"name", material.name},
                          {"baseColour", json_of(material.base_colour)},
                          {"metallic", material.metallic},
                          {"roughness", material.roughness},
                          {"specular", material.specular},
                          {"specularColour", json_of(material.specular_colour)},
                          {"clearCoat", material.clear_coat},
                          {"clearCoatRoughness", material.clear_coat_roughness},
                          {"maxPhong", max_phong_json(material.max_phong)},
                          {"emission", json_of(material.emission)},
                          {"textured", material.base_colour_texture.texture >= 0},
                          {"alphaMode", name_of(material.alpha_mode)},
                          {"doubleSided", material.double_sided}});
    }
    return result;
}

Json lights_json(const Scene& scene) {
    Json result = Json::array();
    for (const Light& light : scene.lights) {
        result.push_back({{"id", light.id},
                          {"name", light.name},
                          {"luminance", luminance(light.radiance)},
                          {"flux", loaded_figures(light).flux},
                          {"radiance", json_of(light.radiance)}});
    }
    for (const PunctualLight& light : scene.punctual_lights) {
        const bool directional = light.kind == PunctualKind::directional;
        const LightFigures figures = loaded_figures(light);
        result.push_back(
            {{"id", result.size() + 1},
             {"name", light.name},
             {"kind", name_of(light.kind)},
             {directional ? "illuminance" : "luminousIntensity",
              directional ? static_cast<double>(luminance(light.intensity)) : figures.peak},
             {"flux", directional ? Json(nullptr) : Json(figures.flux)},
             {"watts", figures.watts > 0.0 ? Json(figures.watts) : Json(nullptr)},
             {"intensity", json_of(light.intensity)}});
    }
    return result;
}

Json cameras_json(const Scene& scene) {
    Json result = Json::array();
    for (const Camera& camera : scene.cameras) {
        result.push_back({{"name", camera.name},
                          {"eye", json_of(camera.eye)},
                          {"target", json_of(camera.target)},
                          {"up", json_of(camera.up)},
                          {"verticalFov", camera.vertical_fov}});
    }
    return result;
}

Json animations_json(const Scene& scene) {
    Json result = Json::array();
    for (std::size_t i = 0; scene.animations && i < scene.animations->animations.size(); ++i) {
        const Animation& animation = scene.animations->animations[i];
        Json objects = Json::array();
        for (const std::uint32_t object : animation.objects) {
            objects.push_back(object + 1);
        }
        Json deformed = Json::array();
        for (const std::uint32_t object : animation.shapes) {
            deformed.push_back(object + 1);
        }
        result.push_back({{"name", animation.name},
                          {"seconds", animation.seconds},
                          {"objects", objects},
                          {"deforms", deformed},
                          {"lights", animation.lights},
                          {"materials", animation.materials}});
    }
    return result;
}

Json textures_json(const Scene& scene) {
    Json result = Json::array();
    for (const Texture& texture : scene.textures) {
        result.push_back(
            {{"name", texture.name}, {"width", texture.width}, {"height", texture.height}});
    }
    return result;
}

}  // namespace

void print_scene_report(std::ostream& out, const Scene& scene, const SceneReport& report) {
    print_summary(out, scene, report);
    print_lists(out, scene);
}

Json scene_report_json(const Scene& scene, const SceneReport& report) {
    Json json = {
        {"name", scene.name},
        {"path", scene.path},
        {"bounds", json_of(scene.bounds)},
        {"origin", {{"x", scene.origin.x}, {"y", scene.origin.y}, {"z", scene.origin.z}}},
        {"triangles", scene.triangles.size()},
        {"vertices", report.referenced_vertices},
        {"area", report.area},
        {"patches", report.patches},
        {"patchTriangles", report.patch_triangles},
        {"joinedTriangles", report.joined_triangles},
        {"joinedPatches", report.joined_patches},
        {"patchVertices", report.patch_vertices},
        {"degenerateTriangles", scene.removed.degenerate_triangles},
        {"duplicateFaces", scene.removed.duplicate_faces},
        {"solidInsides", scene.removed.solid_insides},
        {"boundaryEdges", report.edges.boundary},
        {"nonManifoldEdges", report.edges.non_manifold},
        {"texturedMaterials", report.textured_materials},
        {"doubleSidedMaterials", report.double_sided_materials},
        {"textureBytes", report.texture_bytes},
        {"skyRadiance", json_of(scene.sky_radiance)},
        {"environment", scene.environment ? scene.environment->description() : std::string()},
        {"objects", objects_json(scene)},
        {"materials", materials_json(scene)},
        {"lights", lights_json(scene)},
        {"cameras", cameras_json(scene)},
        {"animations", animations_json(scene)},
        {"textures", textures_json(scene)},
        {"notices", scene.notices}};
    for (const EnclosedLight& lamp : report.enclosed) {
        json["enclosedLights"].push_back({{"light", lamp.light}, {"object", lamp.object}});
    }
    if (report.unit_hint) {
        json["unitHint"] = *report.unit_hint;
    }
    return json;
}

}  // namespace raybundle
