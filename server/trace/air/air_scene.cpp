// SPDX-License-Identifier: Apache-2.0
#include "trace/air/air_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "scene/mix_bits.h"

namespace raybundle {
namespace {

constexpr int most_passes = 32;           // surfaces that a ray passes: glass, cut-outs
constexpr float lift_share = 0x1.0p-20F;  // of the scene's diameter
constexpr float no_end = std::numeric_limits<float>::infinity();

RTCRay ray_of(const glm::vec3& origin, const glm::vec3& direction, float end) {
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tfar = end;
    ray.mask = ~0U;
    return ray;
}

}  // namespace

AirRandom::AirRandom(std::uint64_t seed, std::uint64_t index)
    : state_(mix_bits(mix_bits(seed) ^ mix_bits(~index))) {}

double AirRandom::next() {
    return static_cast<double>(mix_bits(++state_) >> 11U) * 0x1.0p-53;
}

AirScene::AirScene(const Scene& scene, const PatchMesh& mesh,
                   std::span<const glm::mat4> world_from_object, float diameter)
    : positions_(mesh.positions),
      triangles_(mesh.triangles),
      vertex_object_(mesh.vertex_object),
      triangle_material_(mesh.triangle_material),
      back_side_(mesh.back_side),
      side_triangle_(mesh.side_triangle),
      sets_(mesh.patch_sets),
      coverage_(mesh.coverage),
      glass_(scene.materials.size()),
      is_glass_(scene.materials.size()),
      device_(rtcNewDevice(nullptr), rtcReleaseDevice),
      rays_(rtcNewScene(device_.get()), rtcReleaseScene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        update(scene, i);
    }
    build();
    place(world_from_object, diameter);
}

AirScene::~AirScene() = default;

void AirScene::update(const Scene& scene, std::size_t material) {
    is_glass_[material] = is_glass(scene.materials[material]);
    glass_[material] = is_glass_[material] ? bundle_glass(scene, material) : BundleGlass{};
    any_passes_ = !coverage_.empty() ||
                  std::find(is_glass_.begin(), is_glass_.end(), true) != is_glass_.end();
}

void AirScene::build() {
    rtcSetSceneFlags(rays_.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC);
    geometry_ = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    vertices_ = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), 3 * triangles_.size()));
    auto* indices = static_cast<glm::uvec3*>(
        rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), triangles_.size()));
    if (vertices_ == nullptr || indices == nullptr) {
        throw std::runtime_error("rays through the air: out of memory");
    }
    for (std::uint32_t i = 0; i < triangles_.size(); ++i) {
        indices[i] = 3 * i + glm::uvec3(0, 1, 2);
    }
    rtcAttachGeometry(rays_.get(), geometry_);
    rtcReleaseGeometry(geometry_);
}

void AirScene::place(std::span<const glm::mat4> world_from_object, float diameter) {
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const glm::mat4& world = world_from_object[vertex_object_[triangles_[i].x]];
        for (int k = 0; k < 3; ++k) {
            vertices_[3 * i + static_cast<std::size_t>(k)] =
                glm::vec3(world * glm::vec4(positions_[triangles_[i][k]], 1.0F));
        }
    }
    lift_ = lift_share * diameter;
    rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(geometry_);
    rtcCommitScene(rays_.get());
    if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) {
        throw std::runtime_error("rays through the air: building the hierarchy failed");
    }
}

/// Whether a ray goes on behind what it has met.
bool AirScene::passes(const RTCRayHit& hit, AirRandom& random) const {
    const std::uint32_t triangle = hit.hit.primID;
    if (!coverage_.empty() && random.next() >= static_cast<double>(coverage_[triangle])) {
        return true;
    }
    const std::uint32_t material = triangle_material_[triangle];
    if (!is_glass_[material]) {
        return false;
    }
    const glm::vec3 normal(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z);
    const glm::vec3 direction(hit.ray.dir_x, hit.ray.dir_y, hit.ray.dir_z);
    const float cosine =
        std::abs(glm::dot(normal, direction)) / std::max(glm::length(normal), 1e-30F);
    return random.next() < static_cast<double>(glass_[material].passing_share(cosine));
}

std::optional<AirScene::Hit> AirScene::meet(const glm::vec3& origin, const glm::vec3& direction,
                                            AirRandom& random) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit hit{};
    hit.ray = ray_of(origin, direction, no_end);
    for (int pass = 0; pass < most_passes; ++pass) {
        hit.ray.tfar = no_end;
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(rays_.get(), &context, &hit);
        if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
            return std::nullopt;
        }
        if (any_passes_ && passes(hit, random)) {
            hit.ray.tnear = hit.ray.tfar + lift_;
            continue;
        }
        const std::uint32_t triangle = hit.hit.primID;
        const bool front =
            glm::dot(glm::vec3(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z), direction) < 0.0F;
        const std::uint32_t met = front ? triangle : back_side_[triangle];
        const bool glass = is_glass_[triangle_material_[triangle]];
        return Hit{hit.ray.tfar,
                   met == PatchMesh::no_patch || glass ? PatchMesh::no_patch : patch_of(met)};
    }
    return Hit{hit.ray.tfar, PatchMesh::no_patch};
}

/// Whether something lies on a ray before `end`, in its unit of length.
bool AirScene::hidden(const glm::vec3& from, const glm::vec3& direction, float end,
                      AirRandom& random) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (!any_passes_) {
        RTCRay ray = ray_of(from, direction, end);
        rtcOccluded1(rays_.get(), &context, &ray);
        return ray.tfar < 0.0F;
    }
    RTCRayHit hit{};
    hit.ray = ray_of(from, direction, end);
    const float step = lift_ / std::max(glm::length(direction), 1e-30F);
    for (int pass = 0; pass < most_passes; ++pass) {
        hit.ray.tfar = end;
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(rays_.get(), &context, &hit);
        if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
            return false;
        }
        if (!passes(hit, random)) {
            return true;
        }
        hit.ray.tnear = hit.ray.tfar + step;
        if (hit.ray.tnear >= end) {
            return false;
        }
    }
    return true;
}

bool AirScene::open(const glm::vec3& from, const glm::vec3& to, AirRandom& random) const {
    return !hidden(from, to - from, 1.0F, random);
}

bool AirScene::open_towards(const glm::vec3& from, const glm::vec3& direction,
                            AirRandom& random) const {
    return !hidden(from, direction, no_end, random);
}

AirScene::Side AirScene::side(std::uint32_t side) const {
    const std::size_t first = 3 * std::size_t{side_triangle_[side]};
    Side result;
    result.a = vertices_[first];
    result.e1 = vertices_[first + 1] - result.a;
    result.e2 = vertices_[first + 2] - result.a;
    const glm::vec3 across = glm::cross(result.e1, result.e2);
    const float size = glm::length(across);
    const float sign = side < triangles_.size() ? 1.0F : -1.0F;
    result.normal = size > 0.0F ? across * (sign / size) : glm::vec3(0.0F);
    result.area = 0.5F * size * (coverage_.empty() ? 1.0F : coverage_[side_triangle_[side]]);
    return result;
}

std::size_t AirScene::bytes() const {
    // Embree keeps about 200 bytes a triangle of a hierarchy besides.
    constexpr std::size_t of_hierarchy = 200;
    return triangles_.size() * (of_hierarchy + 3 * sizeof(glm::vec3));
}

}  // namespace raybundle
