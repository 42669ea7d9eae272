// SPDX-License-Identifier: Apache-2.0
#include "rooms.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "reference/sampling/discrete_distribution.h"

namespace raybundle {
namespace {

/// Makes the lamp: one square metre of the ceiling of the cube [0, 4]^3.
void light_ceiling(SceneBuilder& builder, float albedo) {
    const auto radiance = static_cast<float>(enclosure_flux / glm::pi<double>());
    const auto lamp = builder.add_material(glm::vec3(albedo), glm::vec3(radiance));
    for (std::size_t i = 0; i < builder.mesh.triangles.size(); ++i) {
        const glm::vec3 c = builder.cell_centre(i);
        if (c.y > 3.99F && c.x > 1.0F && c.x < 2.0F && c.z > 1.0F && c.z < 2.0F) {
            builder.set_triangle_material(i, lamp);
        }
    }
}

Estimate estimate(std::uint32_t count, const std::function<double(std::uint32_t)>& sample) {
    double sum = 0.0;
    double squares = 0.0;
    Estimate result;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double value = sample(i);
        sum += value;
        squares += value * value;
        result.largest = std::max(result.largest, value);
    }
    const double n = count;
    result.mean = sum / n;
    const double variance = std::max(squares / n - result.mean * result.mean, 0.0);
    result.standard_error = std::sqrt(variance / (n - 1.0));
    return result;
}

}  // namespace

Camera camera_at(const glm::vec3& eye, const glm::vec3& target, float fov) {
    Camera camera;
    camera.eye = glm::vec3(odd_rotation() * glm::vec4(eye, 1.0F));
    camera.target = glm::vec3(odd_rotation() * glm::vec4(target, 1.0F));
    camera.vertical_fov = fov;
    return camera;
}

SceneBuilder furnace_room(float albedo, float emission) {
    SceneBuilder b;
    b.set_transform(odd_rotation());
    const auto m = b.add_material(glm::vec3(albedo), glm::vec3(emission));
    constexpr std::uint32_t n = 2;
    for (const auto& [corner, size] : {std::pair{glm::vec2(0, 0), glm::vec2(5, 2)},
                                       std::pair{glm::vec2(0, 2), glm::vec2(2, 2)}}) {
        b.add_quad({corner.x, 0, corner.y}, {0, 0, size.y}, {size.x, 0, 0}, n, n, m);
        b.add_quad({corner.x, 3, corner.y}, {size.x, 0, 0}, {0, 0, size.y}, n, n, m);
    }
    const glm::vec2 outline[] = {{0, 0}, {5, 0}, {5, 2}, {2, 2}, {2, 4}, {0, 4}};
    for (int i = 0; i < 6; ++i) {
        const glm::vec2 from = outline[i];
        const glm::vec2 to = outline[(i + 1) % 6];
        b.add_quad({from.x, 0, from.y}, {to.x - from.x, 0, to.y - from.y}, {0, 3, 0}, n, n, m);
    }
    return b;
}

SceneBuilder enclosure(float albedo, const glm::mat4& where) {
    SceneBuilder b;
    b.set_transform(odd_rotation() * where);
    b.add_box({0, 0, 0}, {4, 4, 4}, true, 4, b.add_material(glm::vec3(albedo)));
    light_ceiling(b, albedo);
    return b;
}

TwoRooms two_rooms(float albedo, float thickness) {
    TwoRooms rooms{enclosure(albedo), 0};
    rooms.first_dark = static_cast<std::uint32_t>(rooms.builder.mesh.patch_count());
    rooms.builder.add_box({4.0F + thickness, 0, 0}, {8.0F + thickness, 4, 4}, true, 5, 0);
    return rooms;
}

std::vector<NamedMaterial> glossy_materials() {
    Material plastic;
    plastic.base_colour = glm::vec3(0.6F, 0.5F, 0.4F);
    plastic.metallic = 0.0F;
    plastic.roughness = 0.3F;
    Material metal;
    metal.base_colour = glm::vec3(0.9F, 0.8F, 0.6F);
    metal.roughness = 0.45F;
    Material phong;
    phong.base_colour = glm::vec3(0.3F, 0.3F, 0.4F);
    phong.max_phong = MaxPhong{glm::vec3(0.45F), 28.0F};
    return {{"plastic", plastic}, {"metal", metal}, {"max_phong", phong}};
}

void add_sphere(SceneBuilder& builder, const glm::vec3& centre, float radius, int rings,
                bool inwards, std::uint32_t material) {
    const auto point = [&](int i, int j) {
        const double theta = glm::pi<double>() * i / rings;
        const double phi = glm::pi<double>() * j / rings;
        return centre + radius * glm::vec3(std::sin(theta) * std::cos(phi), std::cos(theta),
                                           std::sin(theta) * std::sin(phi));
    };
    const auto add = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
        builder.add_triangle(a, inwards ? b : c, inwards ? c : b, material);
    };
    for (int i = 0; i < rings; ++i) {
        for (int j = 0; j < 2 * rings; ++j) {
            if (i > 0) {
                add(point(i, j), point(i + 1, j), point(i, j + 1));
            }
            if (i + 1 < rings) {
                add(point(i, j + 1), point(i + 1, j), point(i + 1, j + 1));
            }
        }
    }
}

std::uint32_t add_material(SceneBuilder& builder, const Material& material) {
    builder.scene.materials.push_back(material);
    return static_cast<std::uint32_t>(builder.scene.materials.size()) - 1;
}

ScreenedLamp screened_lamp(const Material& floor, const glm::vec3& wall_albedo,
                           const glm::vec3& lamp_emission) {
    ScreenedLamp s;
    SceneBuilder& b = s.builder;
    const auto patches = [&b] { return static_cast<std::uint32_t>(b.mesh.patch_count()); };
    b.set_transform(odd_rotation());
    const auto black = b.add_material(glm::vec3(0.0F));
    s.lamp = patches();
    b.add_quad({1, 1.5F, 0}, {0.2F, 0, 0}, {0, 0, 1}, 1, 1,
               b.add_material(glm::vec3(0.0F), lamp_emission));  // faces down
    s.wall = patches();
    b.add_quad({0, 0, 0}, {0, 1, 0}, {0, 0, 1}, 2, 2, b.add_material(wall_albedo));  // faces +x
    s.floor = patches();
    b.add_quad({0, 0, 0}, {0, 0, 1}, {2, 0, 0}, 4, 4, add_material(b, floor));
    // The screen hangs at x = 0.7 from above the lamp down to y = 0.8, wider than the rest.
    b.add_quad({0.7F, 0.8F, -2}, {0, 0, 5}, {0, 1, 0}, 1, 1, black);
    b.add_quad({0.7F, 0.8F, -2}, {0, 1, 0}, {0, 0, 5}, 1, 1, black);
    return s;
}

Estimate mean_irradiance(const RayScene& scene, const PathTracer& tracer, std::uint32_t first,
                         std::uint32_t last, std::uint32_t paths, std::uint64_t seed) {
    std::vector<double> areas;
    for (std::uint32_t patch = first; patch < last; ++patch) {
        areas.push_back(scene.patch_area(patch));
    }
    const DiscreteDistribution patches(areas);
    return estimate(paths, [&](std::uint32_t i) {
        PixelSampler sampler(seed, i, 0, 0);  // a pixel of its own: independent paths
        const auto patch = first + static_cast<std::uint32_t>(patches.sample(sampler.next()));
        const SurfacePoint point =
            scene.point_on_patch(patch, uniform_triangle(sampler.next_pair()));
        return tracer.irradiance(point, sampler).g;
    });
}

Estimate irradiance_at(const PathTracer& tracer, const SurfacePoint& point, std::uint32_t paths,
                       std::uint64_t seed) {
    return estimate(paths, [&](std::uint32_t i) {
        PixelSampler sampler(seed, i, 0, 0);
        return tracer.irradiance(point, sampler).g;
    });
}

}  // namespace raybundle
