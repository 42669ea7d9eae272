// SPDX-License-Identifier: Apache-2.0
#include "reference/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "scene/material/reflectance_grid.h"
#include "scene/material/specular_surface.h"

namespace raybundle {
namespace {

/// Distance in front of a surface at which its rays start, own space: some ten times the rounding
/// errors of single precision at coordinates up to 1.
constexpr double offset = 0x1.0p-20;

/// What the intersection filter of one query needs to know.
struct FrontQuery {
    RTCIntersectContext context{};
    const PatchMesh* mesh = nullptr;
};

/// Lets pass only hits that show a patch.
void reject_absorbing(const RTCFilterFunctionNArguments* arguments) {
    const auto* query = reinterpret_cast<const FrontQuery*>(arguments->context);
    const std::uint32_t triangle = RTCHitN_primID(arguments->hit, 1, 0);
    const float along = RTCHitN_Ng_x(arguments->hit, 1, 0) * RTCRayN_dir_x(arguments->ray, 1, 0) +
                        RTCHitN_Ng_y(arguments->hit, 1, 0) * RTCRayN_dir_y(arguments->ray, 1, 0) +
                        RTCHitN_Ng_z(arguments->hit, 1, 0) * RTCRayN_dir_z(arguments->ray, 1, 0);
    if (along >= 0.0F && query->mesh->back_side[triangle] == PatchMesh::no_patch) {
        arguments->valid[0] = 0;
    }
}

/// Lets rays pass where alpha MASK has cut the surface away.
void reject_uncovered(const RTCFilterFunctionNArguments* arguments) {
    const auto* scene = static_cast<const RayScene*>(arguments->geometryUserPtr);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) {
            continue;
        }
        const glm::dvec2 at(RTCHitN_u(arguments->hit, arguments->N, i),
                            RTCHitN_v(arguments->hit, arguments->N, i));
        if (!scene->covered(RTCHitN_primID(arguments->hit, arguments->N, i), at)) {
            arguments->valid[i] = 0;
        }
    }
}

RTCRay make_ray(const glm::vec3& origin, const glm::vec3& direction, float near, float far) {
    RTCRay ray{};
    ray.org_x = origin.x;
    ray.org_y = origin.y;
    ray.org_z = origin.z;
    ray.dir_x = direction.x;
    ray.dir_y = direction.y;
    ray.dir_z = direction.z;
    ray.tnear = near;
    ray.tfar = far;
    ray.mask = ~0U;
    return ray;
}

/// First hit within (near, far); geomID tells whether there is one.
RTCRayHit intersect(RTCScene scene, RTCIntersectContext& context, const RTCRay& ray) {
    RTCRayHit result{};
    result.ray = ray;
    result.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(scene, &context, &result);
    return result;
}

constexpr std::size_t ray_bundle = 64;  // rays at once
constexpr float infinity = std::numeric_limits<float>::infinity();

void check(RTCDevice device, const char* what) {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE) {
        throw std::runtime_error(std::string("ray casting: ") + what + " failed, Embree error " +
                                 std::to_string(static_cast<int>(error)));
    }
}

}  // namespace

void RayScene::DeviceDeleter::operator()(RTCDevice device) const {
    rtcReleaseDevice(device);
}

void RayScene::SceneDeleter::operator()(RTCScene scene) const {
    rtcReleaseScene(scene);
}

RayScene::RayScene(const Scene& scene, const PatchMesh& mesh)
    : scene_(scene), mesh_(mesh), centre_(scene.bounds.centre()), scale_(1.0) {
    models_.reserve(scene.materials.size());
    for (const Material& material : scene.materials) {
        models_.push_back(reflectance_model(material));
        textured_models_.emplace_back();
        has_panes_ = has_panes_ || specular_kind(material) == SpecularKind::pane;
        if (has_reflectance_grid(material)) {
            textured_models_.back().emplace(material);
        }
    }
    for (const PunctualLight& light : scene.punctual_lights) {
        const bool carrier_removed = light.object != PunctualLight::no_object &&
                                     scene.objects[static_cast<std::size_t>(light.object)].removed;
        if (light.removed || carrier_removed) {
            continue;
        }
        if (const auto body = body_of(place_light(scene, light))) {
            luminaires_.push_back(*body);
        }
    }
    place_vertices();
    find_smooth_triangles();
    build();
}

RayScene::~RayScene() = default;

std::optional<LuminaireHit> RayScene::luminaire_before(
    const glm::dvec3& origin, const glm::dvec3& direction,
    const std::optional<SurfacePoint>& hit) const {
    std::optional<LuminaireHit> nearest;
    if (luminaires_.empty()) {
        return nearest;
    }
    const glm::dvec3 from = origin / scale_ + centre_;
    const double surface = hit ? glm::distance(origin, hit->position) / scale_
                               : std::numeric_limits<double>::infinity();
    for (const LuminaireBody& body : luminaires_) {
        const auto met = meet(body, from, direction);
        if (met && met->distance < surface + body.tolerance(met->distance) &&
            (!nearest || met->distance < nearest->distance)) {
            nearest = met;
        }
    }
    if (nearest) {
        nearest->distance *= scale_;
    }
    return nearest;
}

void RayScene::build() {
    device_.reset(rtcNewDevice(nullptr));
    check(device_.get(), "opening the device");
    embree_.reset(rtcNewScene(device_.get()));
    rtcSetSceneFlags(embree_.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), positions_.size()));
    auto* indices = static_cast<glm::uvec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), mesh_.triangles.size()));
    check(device_.get(), "allocating the geometry");
    std::copy(positions_.begin(), positions_.end(), vertices);
    std::copy(mesh_.triangles.begin(), mesh_.triangles.end(), indices);
    const bool masked =
        std::any_of(scene_.materials.begin(), scene_.materials.end(),
                    [](const Material& m) { return m.alpha_mode == AlphaMode::mask; });
    if (masked) {
        rtcSetGeometryUserData(geometry, this);
        rtcSetGeometryIntersectFilterFunction(geometry, reject_uncovered);
        rtcSetGeometryOccludedFilterFunction(geometry, reject_uncovered);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(embree_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(embree_.get());
    check(device_.get(), "building the hierarchy");
}

std::optional<SurfacePoint> RayScene::trace(const glm::dvec3& origin,
                                            const glm::dvec3& direction) const {
    return trace_ray(glm::vec3(origin), glm::vec3(direction));
}

std::optional<SurfacePoint> RayScene::trace_from(const SurfacePoint& from,
                                                 const glm::dvec3& direction) const {
    return trace_ray(departure(from), glm::vec3(direction));
}

std::optional<SurfacePoint> RayScene::trace_ray(const glm::vec3& origin,
                                                const glm::vec3& direction) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    const RTCRayHit found =
        intersect(embree_.get(), context, make_ray(origin, direction, 0.0F, infinity));
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    const bool front =
        glm::dot(glm::vec3(found.hit.Ng_x, found.hit.Ng_y, found.hit.Ng_z), direction) < 0.0F;
    const SurfacePoint point =
        point_on_triangle(found.hit.primID, front, {found.hit.u, found.hit.v});
    if (!point.absorbs()) {
        return point;
    }
    const auto covering = front_at(point, origin, direction, found.ray.tfar);
    return covering ? covering : point;
}

std::optional<SurfacePoint> RayScene::front_at(const SurfacePoint& back, const glm::vec3& origin,
                                               const glm::vec3& direction, float distance) const {
    FrontQuery query;
    rtcInitIntersectContext(&query.context);
    query.context.filter = reject_absorbing;
    query.mesh = &mesh_;
    const double cosine = std::abs(glm::dot(back.normal, glm::dvec3(direction)));
    const auto reach = static_cast<float>(4.0 * offset / std::max(cosine, 1e-3)) + 1e-6F * distance;
    const RTCRayHit found =
        intersect(embree_.get(), query.context,
                  make_ray(origin, direction, std::max(distance - reach, 0.0F), distance + reach));
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    const bool front =
        glm::dot(glm::vec3(found.hit.Ng_x, found.hit.Ng_y, found.hit.Ng_z), direction) < 0.0F;
    const SurfacePoint point =
        point_on_triangle(found.hit.primID, front, {found.hit.u, found.hit.v});
    if (std::abs(glm::dot(back.normal, point.position - back.position)) > offset) {
        return std::nullopt;
    }
    return point;
}

bool RayScene::occluded(const glm::vec3& origin, const glm::vec3& direction, float length) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRay ray = make_ray(origin, direction, 0.0F, length);
    rtcOccluded1(embree_.get(), &context, &ray);
    return ray.tfar < 0.0F;
}

void RayScene::find_unobstructed(const glm::vec3& point, std::span<const glm::vec3> others,
                                 std::span<bool> open) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    std::array<RTCRay, ray_bundle> rays;
    for (std::size_t first = 0; first < others.size(); first += rays.size()) {
        const std::size_t count = std::min(rays.size(), others.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            rays[i] = make_ray(point, others[first + i] - point, 0.0F, 1.0F);
        }
        rtcOccluded1M(embree_.get(), &context, rays.data(), static_cast<unsigned>(count),
                      sizeof(RTCRay));
        for (std::size_t i = 0; i < count; ++i) {
            open[first + i] = !(rays[i].tfar < 0.0F);
        }
    }
}

bool RayScene::mutually_visible(const SurfacePoint& a, const SurfacePoint& b) const {
    return unobstructed(departure(a), departure(b));
}

bool RayScene::sees_point(const SurfacePoint& from, const glm::dvec3& point) const {
    return unobstructed(departure(from), glm::vec3(point));
}

bool RayScene::sees_sky(const SurfacePoint& from, const glm::dvec3& direction) const {
    return open_towards(departure(from), direction);
}

bool RayScene::open_towards(const glm::vec3& from, const glm::dvec3& direction) const {
    return !occluded(from, glm::vec3(direction), infinity);
}

glm::vec3 RayScene::departure(const SurfacePoint& point) const {
    const glm::uvec3& t = mesh_.triangles[point.triangle];
    const glm::dvec3 a(positions_[t.x]);
    const glm::dvec3 e1 = glm::dvec3(positions_[t.y]) - a;
    const glm::dvec3 e2 = glm::dvec3(positions_[t.z]) - a;
    const double twice_area = glm::length(glm::cross(e1, e2));
    const glm::dvec3 edges(glm::length(e2 - e1), glm::length(e2), glm::length(e1));
    constexpr double largest_shift = 0.1;  // of the height; for triangles of the offset's size
    const glm::dvec3 least = glm::min(offset * edges / twice_area, largest_shift);
    const glm::dvec2& b = point.barycentric;
    glm::dvec3 weights = glm::max(glm::dvec3(1.0 - b.x - b.y, b.x, b.y), least);
    weights /= weights.x + weights.y + weights.z;
    return glm::vec3(a + weights.y * e1 + weights.z * e2 + offset * point.normal);
}

}  // namespace raybundle
