// SPDX-License-Identifier: Apache-2.0
#include "lit_room.h"

#include <cmath>

namespace raybundle {

void add_punctual_light(SceneBuilder& builder, const glm::mat4& world, PunctualKind kind,
                        const glm::vec3& position, const glm::vec3& direction,
                        const glm::vec3& intensity) {
    PunctualLight light;
    light.name = "light";
    light.kind = kind;
    light.position = glm::vec3(world * glm::vec4(position, 1.0F));
    light.axes[2] = -glm::normalize(glm::mat3(world) * direction);
    light.axes[0] = glm::vec3(0.0F);
    light.axes[1] = glm::vec3(0.0F);
    light.intensity = intensity;
    light.inner_cosine = std::cos(glm::radians(20.0F));
    light.outer_cosine = std::cos(glm::radians(35.0F));
    builder.scene.punctual_lights.push_back(light);
}

SceneBuilder lit_room(const glm::mat4& where, std::uint32_t n) {
    SceneBuilder b;
    b.set_transform(where);
    const auto white = b.add_material({0.7F, 0.7F, 0.7F});
    const auto red = b.add_material({0.6F, 0.2F, 0.2F});
    const auto blue = b.add_material({0.2F, 0.3F, 0.6F});
    b.add_quad({0, 0, 0}, {0, 0, 4}, {4, 0, 0}, n, n, white);  // floor
    b.add_quad({0, 3, 0}, {4, 0, 0}, {0, 0, 4}, n, n, white);  // ceiling
    b.add_quad({0, 0, 4}, {0, 3, 0}, {4, 0, 0}, n, n, white);  // back
    b.add_quad({0, 0, 0}, {0, 3, 0}, {0, 0, 4}, n, n, red);
    b.add_quad({4, 0, 0}, {0, 0, 4}, {0, 3, 0}, n, n, blue);
    b.add_box({1.2F, 0, 1.6F}, {2.4F, 1.1F, 2.6F}, false, std::max(n / 3, 1U), white);
    add_punctual_light(b, where, PunctualKind::point, {3.1F, 2.2F, 2.9F}, {0, -1, 0},
                       {90.0F, 80.0F, 60.0F});
    add_punctual_light(b, where, PunctualKind::spot, {0.6F, 2.7F, 1.0F}, {1.2F, -1.8F, 1.0F},
                       {500.0F, 500.0F, 600.0F});
    add_punctual_light(b, where, PunctualKind::directional, {0, 0, 0}, {0.35F, -0.6F, 1.0F},
                       {120.0F, 110.0F, 90.0F});
    return b;
}

Camera lit_room_camera(const glm::mat4& where) {
    Camera camera;
    camera.eye = glm::vec3(where * glm::vec4(2.0F, 1.6F, -3.5F, 1.0F));
    camera.target = glm::vec3(where * glm::vec4(2.0F, 1.4F, 2.0F, 1.0F));
    camera.up = glm::mat3(where) * glm::vec3(0, 1, 0);
    camera.vertical_fov = 0.75F;
    return camera;
}

}  // namespace raybundle
