// SPDX-License-Identifier: Apache-2.0
#include "view/point_probe.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace raybundle {

namespace {

constexpr float distance_share = 1e-3F;  // of the scene's diameter: ten times the near plane's

constexpr float near_share = 1e-4F;  // of it: the near plane

/// Unit normal of a patch on its own side, world.
glm::vec3 normal_of(const Scene& scene, const PatchMesh& mesh, std::uint32_t patch) {
    const glm::uvec3& t = mesh.triangles[mesh.side_triangle[patch]];
    const glm::mat4 world = scene.objects[mesh.vertex_object[t.x]].world_from_object();
    const auto place = [&](unsigned vertex) {
        return glm::vec3(world * glm::vec4(mesh.positions[vertex], 1.0F));
    };
    const glm::vec3 a = place(t.x);
    const glm::vec3 normal = glm::normalize(glm::cross(place(t.y) - a, place(t.z) - a));
    return patch >= mesh.triangles.size() ? -normal : normal;
}

/// Upwards, but not along the line of sight. direction: unit.
glm::vec3 up_for(const glm::vec3& direction) {
    return std::abs(direction.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
}

}  // namespace

float probe_rounding(const GpuScene& gpu_scene, const glm::vec3& point) {
    const glm::vec3 size = glm::abs(point);
    // Derived: each of pose, projection and message rounds a coordinate once.
    const float digits =
        4.0F * std::numeric_limits<float>::epsilon() * std::max({size.x, size.y, size.z});
    return near_share * gpu_scene.diameter() + digits;
}

std::optional<PixelProbe> probe_ray(const GpuScene& gpu_scene, const RadianceStore& store,
                                    const ViewPrograms& programs, const glm::vec3& origin,
                                    const glm::vec3& direction) {
    const glm::vec3 towards = glm::normalize(direction);
    Camera camera;
    camera.eye = origin;
    // Far, so that the direction keeps its digits at coordinates of a map.
    camera.target = origin + std::max(gpu_scene.diameter(), glm::length(origin)) * towards;
    camera.up = up_for(towards);
    ViewerImage image(gpu_scene, store, programs, glm::uvec2(1));
    image.set_camera(camera);
    return image.probe(glm::uvec2(0));
}

std::optional<PixelProbe> probe_point(const GpuScene& gpu_scene, const RadianceStore& store,
                                      const ViewPrograms& programs, const Scene& scene,
                                      const PatchMesh& mesh, std::uint32_t patch,
                                      const glm::vec3& point) {
    const glm::vec3 normal = normal_of(scene, mesh, patch);
    Camera camera;
    camera.target = point;
    camera.eye = point + distance_share * gpu_scene.diameter() * normal;
    camera.up = up_for(normal);
    ViewerImage image(gpu_scene, store, programs, glm::uvec2(1));
    image.set_camera(camera);
    const std::optional<PixelProbe> probe = image.probe(glm::uvec2(0));
    return probe && probe->patch == patch ? probe : std::nullopt;
}

}  // namespace raybundle
