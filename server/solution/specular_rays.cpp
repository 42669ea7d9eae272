// SPDX-License-Identifier: Apache-2.0
#include "solution/specular_rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "scene/mix_bits.h"
#include "scene/patch_colour.h"

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

/// What the intersection filter needs to know.
struct SpecularRays::FrontQuery {
    RTCIntersectContext context{};
    const SpecularRays* rays = nullptr;
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

/// Lets pass only hits on sides that send light.
void SpecularRays::reject_absorbing(const RTCFilterFunctionNArguments* arguments) {
    const auto* query = reinterpret_cast<const FrontQuery*>(arguments->context);
    const Object& object = query->rays->objects_[RTCHitN_instID(arguments->hit, 1, 0, 0)];
    const float along = RTCHitN_Ng_x(arguments->hit, 1, 0) * RTCRayN_dir_x(arguments->ray, 1, 0) +
                        RTCHitN_Ng_y(arguments->hit, 1, 0) * RTCRayN_dir_y(arguments->ray, 1, 0) +
                        RTCHitN_Ng_z(arguments->hit, 1, 0) * RTCRayN_dir_z(arguments->ray, 1, 0);
    const bool front = (along < 0.0F) != object.mirrored;
    if (query->rays->absorbs(object.facets[RTCHitN_primID(arguments->hit, 1, 0)], front)) {
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
                                                    const glm::vec3& direction) const {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    const RTCRayHit found = intersect(scene_.get(), context, origin, direction, 0.0F, infinity);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    Hit hit = hit_of(found.hit.instID[0], found.hit.primID, found.hit.u, found.hit.v,
                     found.ray.tfar, direction);
    if (!absorbs(hit.facet, hit.front)) {
        return hit;
    }
    // Where a front and an absorbing back coincide the front is seen, as in rasterised pictures.
    FrontQuery query;
    rtcInitIntersectContext(&query.context);
    query.context.filter = reject_absorbing;
    query.rays = this;
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

/// One view ray's way.
class SpecularRays::Walk {
  public:
    Walk(const SpecularRays& rays, std::uint32_t seed, std::span<ContinuedRay, most_ends> ends,
         Coats coats)
        : rays_(rays), state_(seed), ends_(ends), coats_(coats) {}

    std::size_t run(const glm::vec3& origin, const glm::vec3& direction) {
        const std::optional<Hit> first = rays_.meet(origin, direction);
        if (!first || !is_specular(*first) || rays_.absorbs(first->facet, first->front)) {
            return 0;
        }
        added_ = rays_.surface(*first).kind == SpecularKind::coat;
        deflect({origin, direction, glm::vec3(1.0F), 0}, *first);
        while (open_count_ > 0) {
            const Branch branch = open_[--open_count_];
            const std::optional<Hit> hit = rays_.meet(branch.origin, branch.direction);
            if (!hit || !is_specular(*hit)) {
                end(branch, hit);
            } else if (!rays_.absorbs(hit->facet, hit->front)) {
                deflect(branch, *hit);
            }
        }
        if (count_ == 0) {  // all light is lost on the way: black
            ends_[count_++] = {origin, ContinuedRay::sky, glm::vec3(0.0F), -direction, added_};
        }
        const auto strongest =
            std::max_element(ends_.begin(), ends_.begin() + static_cast<std::ptrdiff_t>(count_),
                             [](const ContinuedRay& a, const ContinuedRay& b) {
                                 return luminance(a.throughput) < luminance(b.throughput);
                             });
        std::swap(*strongest, ends_.front());
        return count_;
    }

  private:
    struct Branch {
        glm::vec3 origin, direction, throughput;
        int surfaces = 0;
    };

    [[nodiscard]] bool is_specular(const Hit& hit) const {
        const SpecularKind kind = rays_.surface(hit).kind;
        return kind != SpecularKind::none &&
               (kind != SpecularKind::coat || coats_ == Coats::followed);
    }

    void end(const Branch& branch, const std::optional<Hit>& hit) {
        if (hit && rays_.absorbs(hit->facet, hit->front)) {
            return;
        }
        ContinuedRay& ray = ends_[count_++];
        ray.position = hit ? hit->position : branch.origin;
        ray.surface = hit ? 2 * hit->facet + (hit->front ? 0U : 1U) : ContinuedRay::sky;
        ray.throughput = branch.throughput;
        ray.towards = -branch.direction;
        ray.added = added_;
    }

    void deflect(const Branch& branch, const Hit& hit) {
        const SpecularSurface& surface = rays_.surface(hit);
        const float cosine = -glm::dot(branch.direction, hit.normal);
        if (surface.kind == SpecularKind::mirror) {
            follow(branch, hit, mirrored(branch.direction, hit),
                   mirror_reflectance(surface, cosine));
        } else if (surface.kind == SpecularKind::pane) {
            const PaneShares shares = pane_shares(surface, cosine);
            split(branch, hit, shares.reflected, shares.transmitted, branch.direction);
        } else if (surface.kind == SpecularKind::coat) {
            cover(branch, hit, coat_reflectance(surface, cosine));
        } else {
            refract(branch, hit, surface, cosine);
        }
    }

    void refract(Branch branch, const Hit& hit, const SpecularSurface& surface, float cosine) {
        const float index = hit.front ? surface.ior : 1.0F / surface.ior;
        if (!hit.front) {  // it came through the body
            branch.throughput *= glm::exp(-surface.absorption * hit.distance);
        }
        const std::optional<glm::vec3> behind = refracted(branch.direction, hit.normal, index);
        const float reflected = behind ? fresnel_reflectance(cosine, index) : 1.0F;
        split(branch, hit, glm::vec3(reflected), (1.0F - reflected) * surface.tint,
              behind.value_or(branch.direction));
    }

    /// What a clear coat reflects, and what is seen through it: the surface's own record has no
    /// coat, but is dimmed by one (solution/reflectance_tables.h).
    void cover(const Branch& branch, const Hit& hit, float reflected) {
        glm::vec3 share(reflected);
        if (branch.surfaces > 0) {
            Branch below = branch;
            if (count_ + open_count_ + 2 > most_ends) {
                const float chance = reflected / (reflected + 1.0F);
                const bool reflects = random() < chance;
                share = reflects ? share / chance : glm::vec3(0.0F);
                below.throughput *= reflects ? 0.0F : 1.0F / (1.0F - chance);
            }
            if (below.throughput != glm::vec3(0.0F)) {
                end(below, hit);
            }
        }
        follow(branch, hit, mirrored(branch.direction, hit), share);
    }

    /// Both ways, or one of them where there is no room for both.
    void split(const Branch& branch, const Hit& hit, glm::vec3 reflected, glm::vec3 passed,
               const glm::vec3& behind) {
        if (count_ + open_count_ + 2 > most_ends && reflected != glm::vec3(0.0F) &&
            passed != glm::vec3(0.0F)) {
            const float chance = luminance(reflected) / luminance(reflected + passed);
            if (random() < chance) {
                reflected /= chance;
                passed = glm::vec3(0.0F);
            } else {
                passed /= 1.0F - chance;
                reflected = glm::vec3(0.0F);
            }
        }
        follow(branch, hit, mirrored(branch.direction, hit), reflected);
        follow(branch, hit, behind, passed);
    }

    void follow(const Branch& branch, const Hit& hit, const glm::vec3& direction,
                const glm::vec3& share) {
        const glm::vec3 throughput = branch.throughput * share;
        if (std::max({throughput.r, throughput.g, throughput.b}) < least_throughput ||
            branch.surfaces + 1 >= most_surfaces) {
            return;
        }
        const float side = glm::dot(direction, hit.geometric) < 0.0F ? -1.0F : 1.0F;
        open_[open_count_++] = {hit.position + side * rays_.offset_ * hit.geometric, direction,
                                throughput, branch.surfaces + 1};
    }

    /// About the interpolated normal, or the plane's where that would lead into the surface.
    static glm::vec3 mirrored(const glm::vec3& direction, const Hit& hit) {
        const glm::vec3 smooth = glm::reflect(direction, hit.normal);
        return glm::dot(smooth, hit.geometric) > 0.0F ? smooth
                                                      : glm::reflect(direction, hit.geometric);
    }

    /// Uniform in [0, 1).
    float random() {
        state_ = mix_bits(state_);
        return static_cast<float>(state_ >> 40U) * 0x1.0p-24F;
    }

    const SpecularRays& rays_;
    std::uint64_t state_;
    std::span<ContinuedRay, most_ends> ends_;
    Coats coats_;
    bool added_ = false;  // the first surface is a coat
    std::size_t count_ = 0;
    std::array<Branch, most_ends> open_{};
    std::size_t open_count_ = 0;
};

std::size_t SpecularRays::follow(const glm::vec3& origin, const glm::vec3& direction,
                                 std::uint32_t seed, std::span<ContinuedRay, most_ends> ends,
                                 Coats coats) const {
    return Walk(*this, seed, ends, coats).run(origin, direction);
}

}  // namespace raybundle
