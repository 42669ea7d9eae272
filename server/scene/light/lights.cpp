// SPDX-License-Identifier: Apache-2.0
#include "scene/light/lights.h"

#include <algorithm>
#include <string>

#include "scene/mesh/patch_colour.h"

namespace raybundle {
namespace {

/// What the triangles of one emitting material add up to.
struct Emitter {
    double area = 0.0;               // m²
    glm::dvec3 power{0.0};           // radiance times area
    const Object* object = nullptr;  // the first that uses it
};

double world_area(const Scene& scene, const Triangle& triangle, const glm::mat4& world) {
    glm::dvec3 p[3];
    for (int k = 0; k < 3; ++k) {
        p[k] = glm::dmat4(world) *
               glm::dvec4(glm::dvec3(scene.vertices[triangle.vertex[k]].position), 1.0);
    }
    return 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
}

/// Lamps that are switched off as they would be at a strength of 1.
std::vector<Material> as_if_lit(std::vector<Material> materials) {
    for (Material& material : materials) {
        if (material.emission == glm::vec3(0.0F)) {
            material.emission = material.dark_emission;
        }
    }
    return materials;
}

}  // namespace

std::vector<Light> find_lights(const Scene& scene) {
    std::vector<Emitter> emitters(scene.materials.size());
    const std::vector<Material> materials = as_if_lit(scene.materials);
    std::vector<glm::mat4> world;
    for (const Object& object : scene.objects) {
        world.push_back(object.world_from_object());
    }
    for (const Triangle& triangle : scene.triangles) {
        const Material& material = materials[triangle.material];
        if (material.emission == glm::vec3(0.0F)) {
            continue;
        }
        Emitter& emitter = emitters[triangle.material];
        const double area = world_area(scene, triangle, world[triangle.object]);
        const glm::vec3 radiance = patch_emission(
            scene, material,
            {scene.vertices[triangle.vertex[0]].uv, scene.vertices[triangle.vertex[1]].uv,
             scene.vertices[triangle.vertex[2]].uv});
        emitter.area += area;
        emitter.power += area * glm::dvec3(radiance);
        if (emitter.object == nullptr) {
            emitter.object = &scene.objects[triangle.object];
        }
    }
    std::vector<Light> lights;
    for (std::size_t m = 0; m < emitters.size(); ++m) {
        const Emitter& emitter = emitters[m];
        if (emitter.power == glm::dvec3(0.0)) {
            continue;
        }
        const std::string& name = scene.materials[m].name;
        const glm::vec3 radiance(emitter.power / emitter.area);
        const glm::vec3 factor = materials[m].emission;
        const bool dark = scene.materials[m].emission == glm::vec3(0.0F);
        const glm::vec3 emitted = dark ? glm::vec3(0.0F) : radiance;
        glm::vec3 texture(0.0F);
        for (int c = 0; c < 3; ++c) {
            texture[c] = factor[c] > 0.0F ? radiance[c] / factor[c] : 1.0F;
        }
        lights.push_back({static_cast<std::uint32_t>(lights.size() + 1),
                          name.empty() ? emitter.object->name : name, static_cast<int>(m), emitted,
                          radiance / std::max(luminance(radiance), 1e-30F), texture, true,
                          emitted});
    }
    return lights;
}

void measure_lights(Scene& scene) {
    std::vector<double> areas(scene.materials.size());
    std::vector<bool> emits(scene.materials.size());
    for (const Light& light : scene.lights) {
        emits[static_cast<std::size_t>(light.material)] = true;
    }
    for (const Triangle& triangle : scene.triangles) {
        if (emits[triangle.material]) {
            const glm::mat4 world = scene.objects[triangle.object].world_from_object();
            areas[triangle.material] +=
                (two_sided(scene, triangle) ? 2.0 : 1.0) * world_area(scene, triangle, world);
        }
    }
    for (Light& light : scene.lights) {
        light.area = areas[static_cast<std::size_t>(light.material)];
    }
}

}  // namespace raybundle
