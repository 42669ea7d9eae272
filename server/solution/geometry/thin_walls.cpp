// SPDX-License-Identifier: Apache-2.0
#include "solution/geometry/thin_walls.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <vector>

#include "trace/embree_objects.h"

namespace raybundle {

namespace {

constexpr float thin_share = 2e-4F;      // of the scene's diameter
constexpr float sliver_share = 2.5e-3F;  // of the scene's diameter

std::vector<glm::vec3> world_positions(const Scene& scene, const PatchMesh& mesh) {
    std::vector<glm::mat4> matrices;
    for (const Object& object : scene.objects) {
        matrices.push_back(object.placement());  // of what has been removed, too: it may come back
    }
    std::vector<glm::vec3> result;
    result.reserve(mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        result.emplace_back(matrices[mesh.vertex_object[i]] * glm::vec4(mesh.positions[i], 1.0F));
    }
    return result;
}

EmbreeScene build(RTCDevice device, const std::vector<glm::vec3>& positions,
                  const PatchMesh& mesh) {
    EmbreeScene scene(rtcNewScene(device));
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), positions.size()));
    auto* indices = static_cast<glm::uvec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), mesh.triangles.size()));
    std::copy(positions.begin(), positions.end(), vertices);
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), indices);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene.get());
    return scene;
}

}  // namespace

bool has_thin_walls(const Scene& scene, const PatchMesh& mesh) {
    const EmbreeDevice device(rtcNewDevice(nullptr));
    if (!device) {
        return true;  // cannot tell: keep the guard
    }
    const std::vector<glm::vec3> positions = world_positions(scene, mesh);
    const EmbreeScene bvh = build(device.get(), positions, mesh);
    const float limit = thin_share * glm::length(scene.bounds.extent());
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::vec3 cross =
            glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]);
        const float length = glm::length(cross);
        if (length <= 0.0F) {
            continue;
        }
        const glm::vec3 n = cross / length;
        // From just before the surface backwards; the surface itself is met with the opposite
        // facing.
        const glm::vec3 origin =
            (positions[t.x] + positions[t.y] + positions[t.z]) / 3.0F + n * (0.5F * limit);
        RTCRayHit ray{};
        ray.ray.org_x = origin.x;
        ray.ray.org_y = origin.y;
        ray.ray.org_z = origin.z;
        ray.ray.dir_x = -n.x;
        ray.ray.dir_y = -n.y;
        ray.ray.dir_z = -n.z;
        ray.ray.tfar = 1.5F * limit;
        ray.ray.mask = ~0U;
        // Walk through at most a few surfaces within the distance.
        for (int step = 0; step < 4; ++step) {
            ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
            rtcIntersect1(bvh.get(), &context, &ray);
            if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
                break;
            }
            const glm::vec3 hit_normal(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z);
            if (glm::dot(hit_normal, n) < -0.5F * glm::length(hit_normal)) {
                return true;
            }
            ray.ray.tnear = ray.ray.tfar * 1.0001F + 1e-7F * limit;
            ray.ray.tfar = 1.5F * limit;
        }
    }
    return false;
}

bool has_slivers(const Scene& scene, const PatchMesh& mesh) {
    const std::vector<glm::vec3> positions = world_positions(scene, mesh);
    const float limit = sliver_share * glm::length(scene.bounds.extent());
    const std::vector<glm::uvec3>& facets = mesh.facets.empty() ? mesh.triangles : mesh.facets;
    return std::any_of(facets.begin(), facets.end(), [&](const glm::uvec3& t) {
        const glm::vec3 a = positions[t.y] - positions[t.x];
        const glm::vec3 b = positions[t.z] - positions[t.x];
        const float longest = std::max(
            {glm::length(a), glm::length(b), glm::length(positions[t.z] - positions[t.y])});
        return glm::length(glm::cross(a, b)) < limit * longest;
    });
}

}  // namespace raybundle
