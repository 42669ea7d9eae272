// SPDX-License-Identifier: Apache-2.0
#include "scene/walk/world_rays.h"

#include <embree3/rtcore.h>

#include <numeric>

#include "scene/walk/embree_triangles.h"

namespace raybundle {
namespace {

RTCRay ray_from(const glm::vec3& origin, const glm::vec3& direction, float far) {
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tfar = far;
    ray.mask = ~0U;
    return ray;
}

}  // namespace

struct WorldRays::Tree {
    std::unique_ptr<RTCDeviceTy, void (*)(RTCDevice)> device{rtcNewDevice(nullptr),
                                                             rtcReleaseDevice};
    std::unique_ptr<RTCSceneTy, void (*)(RTCScene)> scene{rtcNewScene(device.get()),
                                                          rtcReleaseScene};
};

WorldRays::WorldRays(const Scene& scene) : scene_(scene), tree_(std::make_unique<Tree>()) {
    const std::unique_ptr<RTCGeometryTy, void (*)(RTCGeometry)> geometry{
        rtcNewGeometry(tree_->device.get(), RTC_GEOMETRY_TYPE_TRIANGLE), rtcReleaseGeometry};
    std::vector<std::uint32_t> all(scene.triangles.size());
    std::iota(all.begin(), all.end(), 0U);
    set_triangles(geometry.get(), scene, all);
    rtcCommitGeometry(geometry.get());
    rtcAttachGeometry(tree_->scene.get(), geometry.get());
    rtcCommitScene(tree_->scene.get());
}

WorldRays::~WorldRays() = default;

WorldRays::Hit WorldRays::trace(const glm::vec3& origin, const glm::vec3& direction) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit query{ray_from(origin, direction, std::numeric_limits<float>::infinity()), {}};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(tree_->scene.get(), &context, &query);
    Hit hit;
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return hit;
    }
    hit.distance = query.ray.tfar;
    hit.triangle = query.hit.primID;
    const glm::vec3 normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    const bool towards = glm::dot(normal, direction) < 0.0F;
    hit.front = towards || two_sided(scene_, scene_.triangles[hit.triangle]);
    hit.normal = (towards ? 1.0F : -1.0F) * normal / std::max(glm::length(normal), 1e-30F);
    return hit;
}

bool WorldRays::blocked(const glm::vec3& from, const glm::vec3& to) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = ray_from(from, to - from, 1.0F);
    rtcOccluded1(tree_->scene.get(), &context, &ray);
    return ray.tfar < 0.0F;
}

}  // namespace raybundle
