// SPDX-License-Identifier: Apache-2.0
#include "agreement_views.h"

#include <memory>

#include "lit_room.h"
#include "rooms.h"
#include "scene/light/sky_dome.h"

namespace raybundle {
namespace {

/// A ball of few triangles with the normals of a sphere, so that shading and geometric normals
/// differ much.
void add_smooth_octahedron(SceneBuilder& b, const glm::vec3& centre, float radius,
                           std::uint32_t material) {
    const glm::vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::size_t first = b.mesh.positions.size();
    for (int octant = 0; octant < 8; ++octant) {
        const auto corner = [&](int axis) {
            return centre + ((octant >> axis & 1) != 0 ? radius : -radius) * axes[axis];
        };
        const bool flip = ((octant & 1) + (octant >> 1 & 1) + (octant >> 2 & 1)) % 2 == 0;
        b.add_triangle(corner(0), corner(flip ? 2 : 1), corner(flip ? 1 : 2), material);
    }
    const glm::vec3 middle(odd_rotation() * glm::vec4(centre, 1.0F));
    for (std::size_t i = first; i < b.mesh.positions.size(); ++i) {
        b.mesh.normals[i] = glm::normalize(b.mesh.positions[i] - middle);
    }
}

/// A closed room, its lamp out of sight, with a box of plastic and a smooth ball.
View furnished_room() {
    View view{enclosure(0.6F), camera_at({0.3F, 1.6F, 0.3F}, {2.6F, 0.9F, 2.8F}, 1.0F)};
    SceneBuilder& b = view.builder;
    b.add_box({2.2F, 0, 1.2F}, {3.2F, 1.2F, 2.2F}, false, 1,
              add_material(b, glossy_materials()[0].material));
    add_smooth_octahedron(b, {1.4F, 0.9F, 2.6F}, 0.7F, b.add_material({0.8F, 0.5F, 0.3F}));
    return view;
}

/// Light by a glossy floor alone, and a dim sky.
View screened_view(std::size_t material) {
    View view{screened_lamp(glossy_materials()[material].material, glm::vec3(0.5F)).builder,
              camera_at({1.9F, 0.6F, 0.9F}, {0.2F, 0.25F, 0.5F}, 0.8F)};
    view.builder.scene.sky_radiance = glm::vec3(4.0F, 5.0F, 6.0F);
    return view;
}

/// Punctual lights of all kinds, a sky that varies over direction, and a sun with a wide disc.
View lit_view() {
    View view{lit_room(odd_rotation(), 1), lit_room_camera(odd_rotation())};
    SkyDomeSettings sky;
    sky.sky.type = CieSky::standard_clear;
    sky.zenith_luminance = 6.0;
    sky.sun_illuminance = 80.0;
    sky.sun_elevation = 0.6;
    sky.sun_azimuth = 0.4;
    sky.sun_radius = 0.08;
    set_environment(std::make_shared<const SkyDome>(sky), view.builder.scene);
    return view;
}

Material glass(float thickness) {
    Material material;
    material.metallic = 0.0F;
    material.roughness = 0.0F;
    material.transmission = 1.0F;
    material.thickness = thickness;
    return material;
}

Material mirror() {
    Material material;
    material.base_colour = glm::vec3(0.9F, 0.8F, 0.7F);
    material.metallic = 1.0F;
    material.roughness = 0.0F;
    return material;
}

/// Light by way of a mirror, a pane and a tinted body, seen through them and beside them.
View glass_view() {
    View view{enclosure(0.6F), camera_at({0.3F, 1.6F, 0.3F}, {2.2F, 1.1F, 2.6F}, 1.1F)};
    SceneBuilder& b = view.builder;
    Material pane = glass(0.0F);
    pane.base_colour = glm::vec3(0.7F, 0.9F, 0.8F);
    b.add_quad({2.0F, 0.2F, 1.0F}, {0.4F, 1.6F, 0}, {0.2F, 0, 1.2F}, 1, 1, add_material(b, pane));
    Material body = glass(1.0F);
    body.attenuation_colour = glm::vec3(0.9F, 0.5F, 0.3F);
    body.attenuation_distance = 0.5F;
    b.add_box({0.9F, 0.4F, 2.3F}, {1.7F, 1.3F, 2.9F}, false, 1, add_material(b, body));
    b.add_quad({3.9F, 0.3F, 2.2F}, {0, 0, 1.4F}, {-0.3F, 2.0F, 0}, 1, 1, add_material(b, mirror()));
    return view;
}

/// The floor of a room under a prism of glass and beside a mirror.
View caustic_view() {
    View view{enclosure(0.5F), camera_at({2.0F, 0.7F, 2.0F}, {1.6F, 0.0F, 1.2F}, 1.2F)};
    SceneBuilder& b = view.builder;
    const auto prism = add_material(b, glass(1.0F));
    const glm::vec3 low[] = {{0.9F, 1.4F, 1.0F}, {2.1F, 1.5F, 0.9F}, {1.5F, 1.3F, 1.9F}};
    const glm::vec3 high(1.5F, 2.3F, 1.3F);
    b.add_triangle(low[0], low[1], low[2], prism);
    for (int i = 0; i < 3; ++i) {
        b.add_triangle(low[(i + 1) % 3], low[i], high, prism);
    }
    b.add_quad({0.1F, 0.3F, 0.2F}, {0, 0, 2.0F}, {0.5F, 1.8F, 0}, 1, 1, add_material(b, mirror()));
    return view;
}

/// Leans the normals of `count` vertices to one side, by angles that differ a little as on a bent
/// surface.
void lean_normals(SceneBuilder& b, std::size_t first, std::size_t count, const glm::vec3& to) {
    for (std::size_t i = first; i < first + count; ++i) {
        const glm::vec3 own = (i % 3 == 0 ? 0.8F : 1.0F) * to;
        b.mesh.normals[i] =
            glm::normalize(b.mesh.normals[i] + glm::vec3(odd_rotation() * glm::vec4(own, 0.0F)));
    }
}

/// A floor lit by way of a mirror and a slab whose normals all lean to one side, under a black
/// plate: the power that they throw and the radiance that is seen by way of them must agree.
/// Nothing is seen at grazing angles, where such a mirror is none.
View leaning_view() {
    View view{{}, camera_at({2.0F, 0.9F, 3.9F}, {1.9F, 0.0F, 2.0F}, 0.9F), 4};
    SceneBuilder& b = view.builder;
    b.set_transform(odd_rotation());
    b.add_quad({0, 0, 0}, {0, 0, 4}, {4, 0, 0}, 1, 1, b.add_material({0.6F, 0.5F, 0.4F}));
    b.add_quad({2, 3, 1}, {2, 0, 0}, {0, 0, 2}, 1, 1,
               b.add_material(glm::vec3(0.0F), glm::vec3(100.0F)));
    b.add_quad({0.9F, 1.1F, 0}, {0, 0, 4}, {1.6F, 0, 0}, 1, 1, b.add_material(glm::vec3(0.0F)));
    std::size_t first = b.mesh.positions.size();
    b.add_quad({0.1F, 0.7F, 1.0F}, {0, 1.3F, 0}, {0, 0, 2}, 1, 1, add_material(b, mirror()));
    lean_normals(b, first, 6, {0, -0.3F, 0});
    first = b.mesh.positions.size();
    b.add_box({2.5F, 1.0F, 1.0F}, {3.9F, 1.2F, 3.0F}, false, 1, add_material(b, glass(0.2F)));
    lean_normals(b, first + 12, 12, {0.3F, 0, 0});  // top and bottom
    return view;
}

/// A dull block cast in clear glass, close up.
View immersed_view() {
    View view{enclosure(0.6F), camera_at({1.0F, 1.5F, 0.6F}, {2.0F, 1.2F, 2.0F}, 0.4F)};
    SceneBuilder& b = view.builder;
    b.add_box({1.4F, 0.6F, 1.4F}, {2.6F, 1.8F, 2.6F}, false, 1, add_material(b, glass(1.0F)));
    b.add_box({1.7F, 0.9F, 1.7F}, {2.3F, 1.5F, 2.3F}, false, 1, b.add_material({0.3F, 0.7F, 0.6F}));
    return view;
}

}  // namespace

View agreement_view(int index) {
    switch (index) {
        case 0:
            return furnished_room();
        case 4:
            return lit_view();
        case 5:
            return glass_view();
        case 6:
            return caustic_view();
        case 7:
            return leaning_view();
        case 8:
            return immersed_view();
        default:
            return screened_view(static_cast<std::size_t>(index - 1));
    }
}

}  // namespace raybundle
