// SPDX-License-Identifier: Apache-2.0
#include "solution/specular/specular_rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "scene/mesh/patch_colour.h"

namespace raybundle {
namespace {

constexpr float offset_share = 0x1.0p-19F;  // of the scene's diameter

RTCRayHit intersect(RTCScene scene, RTCIntersectContext& context, const glm::vec3& origin,
                    const glm::vec3& direction, float near, float far) {
    RTCRayHit result{};
    result.ray.org_x = origin.x;
    result.ray.org_y = origin.y;
    result.ray.org_z = origin.z;
    result.ray.dir_x = direction.x;
    result.ray.dir_y = direction.y;
    result.ray.dir_z = direction.z;
    result.ray.tnear = near;
    result.ray.tfar = far;
    result.ray.mask = ~0U;
    result.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    result.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &result);
    return result;
}

float diameter_of(const std::vector<glm::vec3>& positions,
                  const std::vector<std::uint32_t>& vertex_object,
                  std::span<const glm::mat4> world_from_object) {
    Bounds box;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        box.add(glm::vec3(world_from_object[vertex_object[i]] * glm::vec4(positions[i], 1.0F)));
    }
    return glm::length(box.extent());
}

}  // namespace

/// What the intersection filter needs to know. The context comes first, since Embree hands on its
/// address.
struct SpecularRays::RayQuery {
    RTCIntersectContext context{};
    const SpecularRays* rays;
    std::span<const std::uint32_t> hidden;
    bool sends = false;  ///< only sides that send light are met

    RayQuery(const SpecularRays& of, std::span<const std::uint32_t> without)
        : rays(&of), hidden(without) {
        rtcInitIntersectContext(&context);
        context.filter = hidden.empty() ? nullptr : filter;
    }
    void meet_what_sends() {
        sends = true;
        context.filter = filter;
    }
};

SpecularRays::SpecularRays(const Scene& scene, const PatchMesh& mesh,
                           std::span<const glm::mat4> world_from_object)
    : positions_(mesh.positions),
      normals_(mesh.normals),
      vertex_object_(mesh.vertex_object),
      facets_(mesh.facets.empty() ? mesh.triangles : mesh.facets),
      materials_(mesh.facets.empty() ? mesh.triangle_material : mesh.facet_material),
      surfaces_(scene.materials.size()),
      two_sided_(scene.materials.size()),
      offset_(offset_share * diameter_of(positions_, mesh.vertex_object, world_from_object)),
      medium_(scene.medium),
      air_low_(scene.bounds.min - scene.bounds.centre()),
      air_high_(scene.bounds.max - scene.bounds.centre()),
      device_(rtcNewDevice(nullptr), rtcReleaseDevice),
      objects_(scene.objects.size()),
      scene_(rtcNewScene(device_.get()), rtcReleaseScene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        classify(scene, i);
    }
    for (std::uint32_t i = 0; i < facets_.size(); ++i) {
        objects_[mesh.vertex_object[facets_[i].x]].facets.push_back(i);
    }
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION |
                                       RTC_SCENE_FLAG_DYNAMIC);
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        if (!objects_[i].facets.empty()) {
            build(objects_[i]);
            rtcAttachGeometryByID(scene_.get(), objects_[i].instance, static_cast<unsigned>(i));
            rtcReleaseGeometry(objects_[i].instance);
            place(static_cast<std::uint32_t>(i), world_from_object[i]);
        }
    }
    rtcCommitScene(scene_.get());
    if (const RTCError error = rtcGetDeviceError(device_.get()); error != RTC_ERROR_NONE) {
        throw std::runtime_error("view rays: building the hierarchy failed, Embree error " +
                                 std::to_string(static_cast<int>(error)));
    }
    bytes_ = facets_.size() * (sizeof(glm::uvec3) + 2 * sizeof(std::uint32_t)) +
             2 * positions_.size() * sizeof(glm::vec3);
}

SpecularRays::~SpecularRays() = default;

void SpecularRays::classify(const Scene& scene, std::size_t material) {
    const Material& m = scene.materials[material];
    surfaces_[material] = specular_surface(m, mean_base_colour(scene, m));
    two_sided_[material] = m.double_sided || surfaces_[material].is_glass();
}

void SpecularRays::update(const Scene& scene, std::size_t material) {
    classify(scene, material);
}

void SpecularRays::build(Object& object) {
    object.hierarchy = {rtcNewScene(device_.get()), rtcReleaseScene};
    rtcSetSceneFlags(object.hierarchy.get(),
                     RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), 3 * object.facets.size()));
    auto* indices = static_cast<glm::uvec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), object.facets.size()));
    if (vertices == nullptr || indices == nullptr) {
        throw std::runtime_error("view rays: out of memory");
    }
    for (std::uint32_t i = 0; i < object.facets.size(); ++i) {
        const glm::uvec3& facet = facets_[object.facets[i]];
        for (int k = 0; k < 3; ++k) {
            vertices[3 * i + static_cast<std::uint32_t>(k)] = positions_[facet[k]];
        }
        indices[i] = 3 * i + glm::uvec3(0, 1, 2);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(object.hierarchy.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(object.hierarchy.get());
    object.instance = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(object.instance, object.hierarchy.get());
}

void SpecularRays::place(std::uint32_t object, const glm::mat4& world_from_object) {
    Object& placed = objects_[object];
    placed.world_from_object = world_from_object;
    if (placed.instance == nullptr) {
        return;
    }
    const float determinant = glm::determinant(glm::mat3(world_from_object));
    placed.mirrored = determinant < 0.0F;
    if (determinant == 0.0F) {  // flat or gone
        rtcDisableGeometry(placed.instance);
    } else {
        rtcEnableGeometry(placed.instance);
        rtcSetGeometryTransform(placed.instance, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                                &world_from_object[0][0]);
    }
    rtcCommitGeometry(placed.instance);
    rtcCommitScene(scene_.get());
}

/// Takes out what is hidden and, where the query wants, sides that send no light.
void SpecularRays::filter(const RTCFilterFunctionNArguments* arguments) {
    const auto& query = *reinterpret_cast<const RayQuery*>(arguments->context);
    const unsigned number = RTCHitN_instID(arguments->hit, 1, 0, 0);
    if (std::find(query.hidden.begin(), query.hidden.end(), number) != query.hidden.end()) {
        arguments->valid[0] = 0;
        return;
    }
    if (!query.sends) {
        return;
    }
    const Object& object = query.rays->objects_[number];
    const float along = RTCHitN_Ng_x(arguments->hit, 1, 0) * RTCRayN_dir_x(arguments->ray, 1, 0) +
                        RTCHitN_Ng_y(arguments->hit, 1, 0) * RTCRayN_dir_y(arguments->ray, 1, 0) +
                        RTCHitN_Ng_z(arguments->hit, 1, 0) * RTCRayN_dir_z(arguments->ray, 1, 0);
    const bool front = (along < 0.0F) != object.mirrored;
    if (query.rays->absorbs(object.facets[RTCHitN_primID(arguments->hit, 1, 0)], front)) {
        arguments->valid[0] = 0;
    }
}

SpecularRays::Hit SpecularRays::hit_of(std::uint32_t object, std::uint32_t primitive, float u,
                                       float v, float distance, const glm::vec3& direction) const {
    const Object& placed = objects_[object];
    Hit hit;
    hit.facet = placed.facets[primitive];
    hit.distance = distance;
    const glm::uvec3& corners = facets_[hit.facet];
    const auto world = [&](std::uint32_t vertex) {
        return glm::vec3(placed.world_from_object * glm::vec4(positions_[vertex], 1.0F));
    };
    const glm::vec3 a = world(corners.x);
    const glm::vec3 e1 = world(corners.y) - a;
    const glm::vec3 e2 = world(corners.z) - a;
    hit.position = a + u * e1 + v * e2;
    const glm::vec3 plane = glm::normalize(glm::cross(e1, e2));
    hit.front = glm::dot(plane, direction) < 0.0F;
    hit.geometric = hit.front ? plane : -plane;
    // Normals transform by the cofactor matrix (the inverse transpose times the determinant).
    const glm::mat3 m(placed.world_from_object);
    const glm::mat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                              glm::cross(m[0], m[1]));
    const glm::vec3 n = cofactors * ((1.0F - u - v) * normals_[corners.x] +
                                     u * normals_[corners.y] + v * normals_[corners.z]);
    const float length = glm::length(n);
    const float side = glm::dot(n, hit.geometric) < 0.0F ? -1.0F : 1.0F;
    hit.normal = length > 0.0F ? n * (side / length) : hit.geometric;
    // Where the interpolated normal looks away from the ray only the plane's makes sense.
    if (glm::dot(hit.normal, direction) >= 0.0F) {
        hit.normal = hit.geometric;
    }
    return hit;
}

std::optional<SpecularRays::Hit> SpecularRays::meet(const glm::vec3& origin,
                                                    const glm::vec3& direction,
                                                    std::span<const std::uint32_t> hidden) const {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    RayQuery query(*this, hidden);
    const RTCRayHit found =
        intersect(scene_.get(), query.context, origin, direction, 0.0F, infinity);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    Hit hit = hit_of(found.hit.instID[0], found.hit.primID, found.hit.u, found.hit.v,
                     found.ray.tfar, direction);
    if (!absorbs(hit.facet, hit.front)) {
        return hit;
    }
    // Where a front and an absorbing back coincide the front is seen, as in rasterised pictures.
    query.meet_what_sends();
    const float reach =
        4.0F * offset_ / std::max(std::abs(glm::dot(hit.geometric, direction)), 1e-3F);
    const RTCRayHit covering =
        intersect(scene_.get(), query.context, origin, direction,
                  std::max(hit.distance - reach, 0.0F), hit.distance + reach);
    if (covering.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return hit;
    }
    const Hit front = hit_of(covering.hit.instID[0], covering.hit.primID, covering.hit.u,
                             covering.hit.v, covering.ray.tfar, direction);
    const bool coincides =
        std::abs(glm::dot(hit.geometric, front.position - hit.position)) <= offset_;
    return coincides ? front : hit;
}

std::array<glm::vec3, 3> SpecularRays::corners(const glm::uvec3& vertices) const {
    const glm::mat4& world = objects_[vertex_object_[vertices.x]].world_from_object;
    std::array<glm::vec3, 3> result;
    for (int k = 0; k < 3; ++k) {
        result[static_cast<std::size_t>(k)] =
            glm::vec3(world * glm::vec4(positions_[vertices[k]], 1.0F));
    }
    return result;
}

glm::vec3 SpecularRays::weights(std::uint32_t facet, const glm::vec3& position) const {
    const auto [a, b, c] = corners(facets_[facet]);
    const glm::vec3 e1 = b - a;
    const glm::vec3 e2 = c - a;
    const glm::vec3 across = glm::cross(e1, e2);
    const float square = std::max(glm::dot(across, across), std::numeric_limits<float>::min());
    const glm::vec3 p = position - a;
    const float w1 = glm::dot(glm::cross(p, e2), across) / square;
    const float w2 = glm::dot(glm::cross(e1, p), across) / square;
    return {1.0F - w1 - w2, w1, w2};
}

std::vector<Bounds> SpecularRays::boxes(Coats coats) const {
    std::vector<Bounds> result;
    for (const Object& object : objects_) {
        Bounds box;
        for (const std::uint32_t facet : object.facets) {
            const SpecularKind kind = surfaces_[materials_[facet]].kind;
            if (kind == SpecularKind::none ||
                (kind == SpecularKind::coat && coats == Coats::passed)) {
                continue;
            }
            for (int k = 0; k < 3; ++k) {
                box.add(glm::vec3(object.world_from_object *
                                  glm::vec4(positions_[facets_[facet][k]], 1.0F)));
            }
        }
        if (!box.empty()) {
            result.push_back(box);
        }
    }
    return result;
}

}  // namespace raybundle
