// SPDX-License-Identifier: Apache-2.0
#include "zones/exchange_rays.h"

#include <embree3/rtcore.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <numeric>
#include <stdexcept>

#include "scene/light/environment.h"
#include "scene/mesh/patch_means.h"

namespace raybundle {

namespace {

constexpr std::size_t rays_per_patch = 8;
constexpr std::size_t min_rays = 32768;
constexpr std::size_t max_rays = 65536;
constexpr int max_passes = 32;            // surfaces that a ray passes: glass, cut-outs
constexpr float lift_share = 0x1.0p-20F;  // of the scene's diameter
constexpr float tie_lifts = 4.0F;         // surfaces that are nearer to each other coincide

// Shares of the rays by area, by number of patches, by emitted flux; the rest by object. Small
// rooms on large sites, and small lamps, have rays, too.
constexpr double by_area = 0.4;
constexpr double by_number = 0.3;
constexpr double by_emission = 0.2;

/// The unique root above 1 of x^5 = x + 1, whose powers make an additive sequence in 4 dimensions
/// (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences").
constexpr double root = 1.1673039782614187;

float fraction(double value) {
    return static_cast<float>(value - std::floor(value));
}

/// Mixes bits (splitmix64).
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9e3779b97f4a7c15ULL;
    x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    x = (x ^ (x >> 27U)) * 0x94d049bb133111ebULL;
    return x ^ (x >> 31U);
}

float random_number(std::uint64_t seed) {
    return static_cast<float>(mixed(seed) >> 40U) * 0x1.0p-24F;
}

glm::vec3 cosine_direction(const glm::vec3& normal, float u, float v) {
    const glm::vec3 helper = std::abs(normal.x) < 0.5F ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 tangent = glm::normalize(glm::cross(normal, helper));
    const float radius = std::sqrt(u);
    const float angle = v * glm::two_pi<float>();
    return radius * (std::cos(angle) * tangent + std::sin(angle) * glm::cross(normal, tangent)) +
           std::sqrt(std::max(1.0F - u, 0.0F)) * normal;
}

}  // namespace

/// What the intersection filter needs to know.
struct ExchangeRays::Query {
    RTCIntersectContext context{};
    const ExchangeRays* rays = nullptr;
};

/// Lets pass only hits on sides that have a patch.
void ExchangeRays::reject_backs(const RTCFilterFunctionNArguments* arguments) {
    const auto* query = reinterpret_cast<const Query*>(arguments->context);
    const float along = RTCHitN_Ng_x(arguments->hit, 1, 0) * RTCRayN_dir_x(arguments->ray, 1, 0) +
                        RTCHitN_Ng_y(arguments->hit, 1, 0) * RTCRayN_dir_y(arguments->ray, 1, 0) +
                        RTCHitN_Ng_z(arguments->hit, 1, 0) * RTCRayN_dir_z(arguments->ray, 1, 0);
    const std::uint32_t triangle = RTCHitN_primID(arguments->hit, 1, 0);
    if (along >= 0.0F && query->rays->back_side_[triangle] == PatchMesh::no_patch) {
        arguments->valid[0] = 0;
    }
}

ExchangeRays::ExchangeRays(const Scene& scene, const PatchMesh& mesh,
                           std::span<const glm::mat4> world_from_object, float diameter,
                           std::uint64_t seed)
    : scene_(scene),
      positions_(mesh.positions),
      vertex_object_(mesh.vertex_object),
      triangle_material_(mesh.triangle_material),
      back_side_(mesh.back_side),
      side_triangle_(mesh.side_triangle),
      sets_(mesh.patch_sets),
      coverage_(mesh.coverage),
      world_from_object_(world_from_object.begin(), world_from_object.end()),
      offsets_(random_number(4 * seed), random_number(4 * seed + 1), random_number(4 * seed + 2),
               random_number(4 * seed + 3)),
      device_(rtcNewDevice(nullptr), rtcReleaseDevice),
      rays_(rtcNewScene(device_.get()), rtcReleaseScene) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        is_glass_.push_back(is_glass(scene.materials[i]));
        glass_.push_back(is_glass_.back() ? bundle_glass(scene, i) : BundleGlass{});
    }
    build(mesh.triangles);
    areas_.resize(mesh.patch_count());
    for (std::uint32_t patch = 0; patch < areas_.size(); ++patch) {
        objects_.push_back(vertex_object_[triangles_[mesh.triangle_of(patch)].x]);
    }
    place(world_from_object, diameter);
    choose_densities(mesh);
}

ExchangeRays::~ExchangeRays() = default;

void ExchangeRays::build(std::span<const glm::uvec3> triangles) {
    rtcSetSceneFlags(rays_.get(), RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC |
                                      RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
    geometry_ = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const vertices = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), positions_.size()));
    auto* const indices = static_cast<glm::uvec3*>(
        rtcSetNewGeometryBuffer(geometry_, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), triangles.size()));
    if (vertices == nullptr || indices == nullptr) {
        throw std::runtime_error("rays between surfaces: out of memory");
    }
    std::copy(triangles.begin(), triangles.end(), indices);
    vertices_ = {vertices, positions_.size()};
    triangles_ = {indices, triangles.size()};
    rtcAttachGeometry(rays_.get(), geometry_);
    rtcReleaseGeometry(geometry_);
}

ExchangeRays::Corners ExchangeRays::corners_of(std::size_t triangle) const {
    const glm::uvec3& t = triangles_[triangle];
    return {vertices_[t.x], vertices_[t.y], vertices_[t.z]};
}

void ExchangeRays::place(std::span<const glm::mat4> world_from_object, float diameter) {
    world_from_object_.assign(world_from_object.begin(), world_from_object.end());
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        const glm::mat4& world = world_from_object_[vertex_object_[i]];
        vertices_[i] = glm::vec3(world * glm::vec4(positions_[i], 1.0F));
    }
    diameter_ = diameter;
    lift_ = lift_share * diameter;
    rtcUpdateGeometryBuffer(geometry_, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(geometry_);
    rtcCommitScene(rays_.get());
    if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) {
        throw std::runtime_error("rays between surfaces: building the hierarchy failed");
    }
    centres_.resize(areas_.size());
    normals_.resize(areas_.size());
    side_areas_.resize(side_triangle_.size());
    for (std::uint32_t i = 0; i < areas_.size(); ++i) {
        measure(i);
    }
}

/// Area, mean place and mean normal of a patch.
void ExchangeRays::measure(std::uint32_t patch) {
    const PatchSides sides = sides_of(patch);
    glm::vec3 centre(0.0F);
    glm::vec3 facing(0.0F);
    float whole = 0.0F;
    areas_[patch] = 0.0F;
    for (const std::uint32_t side : sides) {
        const Corners at = corners_of(side_triangle_[side]);
        const glm::vec3 across = glm::cross(at.b - at.a, at.c - at.a);
        const float size = glm::length(across);
        const float sign = side < triangles_.size() ? 1.0F : -1.0F;
        centre = (at.a + at.b + at.c) / 3.0F;
        facing += sign * across;
        side_areas_[side] = 0.5F * size;
        whole += side_areas_[side];
        areas_[patch] += side_areas_[side] * (coverage_.empty() ? 1.0F : coverage_[side]);
    }
    if (sides.size() > 1) {
        glm::vec3 sum(0.0F);
        for (const std::uint32_t side : sides) {
            const Corners at = corners_of(side_triangle_[side]);
            sum += side_areas_[side] * (at.a + at.b + at.c) / 3.0F;
        }
        centre = whole > 0.0F ? sum / whole : centre;
    }
    const float size = glm::length(facing);
    centres_[patch] = centre;
    normals_[patch] = size > 0.0F ? facing / size : glm::vec3(0.0F);
}

/// Side of a patch, by area. share: a number from [0, 1), and what is left of its chance.
std::uint32_t ExchangeRays::side_within(std::uint32_t patch, float& share) const {
    const PatchSides sides = sides_of(patch);
    if (sides.size() == 1) {
        return sides.front();
    }
    float whole = 0.0F;
    for (const std::uint32_t side : sides) {
        whole += side_areas_[side];
    }
    float left = share * whole;
    std::uint32_t chosen = sides.front();
    for (const std::uint32_t side : sides) {
        if (side_areas_[side] <= 0.0F) {
            continue;
        }
        chosen = side;
        if (left < side_areas_[side]) {
            break;
        }
        left -= side_areas_[side];
    }
    share = std::clamp(left / side_areas_[chosen], 0.0F, 1.0F);
    return chosen;
}

bool ExchangeRays::choose_densities(const PatchMesh& mesh) {
    const std::vector<double> before = std::move(shares_);
    const std::size_t patches = areas_.size();
    const std::vector<glm::vec3> radiance = patch_means(mesh, mesh.emission);
    double area = 0.0;
    double emission = 0.0;
    std::vector<double> object_area(world_from_object_.size(), 0.0);
    const auto emitted = [&](std::size_t i) {
        return static_cast<double>(areas_[i] * luminance(radiance[i]));
    };
    for (std::size_t i = 0; i < patches; ++i) {
        area += static_cast<double>(areas_[i]);
        object_area[objects_[i]] += static_cast<double>(areas_[i]);
        emission += emitted(i);
    }
    const auto objects = static_cast<double>(
        std::count_if(object_area.begin(), object_area.end(), [](double a) { return a > 0.0; }));
    shares_.assign(patches, 0.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < patches; ++i) {
        if (areas_[i] <= 0.0F) {
            continue;
        }
        const auto own = static_cast<double>(areas_[i]);
        shares_[i] =
            by_area * own / area + by_number / static_cast<double>(patches) +
            (1.0 - by_area - by_number - by_emission) * own / (object_area[objects_[i]] * objects) +
            (emission > 0.0 ? by_emission * emitted(i) / emission : 0.0);
        sum += shares_[i];
    }
    starts_.clear();
    if (sum <= 0.0) {
        return shares_ != before;
    }
    const std::size_t rays = std::clamp(rays_per_patch * patches, min_rays, max_rays);
    double running = 0.0;
    for (std::size_t i = 0; i < patches; ++i) {
        shares_[i] /= sum;
        running += shares_[i];
        while (starts_.size() < rays &&
               (static_cast<double>(starts_.size()) + 0.5) / static_cast<double>(rays) < running) {
            starts_.push_back(static_cast<std::uint32_t>(i));
        }
    }
    return shares_ != before;
}

std::vector<double> ExchangeRays::rays_per_area() const {
    std::vector<double> result(areas_.size(), 0.0);
    for (std::size_t i = 0; i < areas_.size(); ++i) {
        if (areas_[i] > 0.0F) {
            result[i] =
                shares_[i] * static_cast<double>(starts_.size()) / static_cast<double>(areas_[i]);
        }
    }
    return result;
}

void ExchangeRays::look_up_sky(ExchangeRay& ray) const {
    if (ray.towards != glm::vec3(0.0F)) {
        ray.sky = ray.left_by_air * glm::vec3(sky_towards(scene_, glm::dvec3(ray.towards)));
    }
}

ExchangeRay ExchangeRays::follow(std::uint32_t patch, std::uint64_t number) const {
    ExchangeRay result;
    result.from = patch;
    if (areas_[patch] <= 0.0F) {
        return result;  // an object that has shrunk to nothing
    }
    const auto n = static_cast<double>(number);
    float u = fraction(static_cast<double>(offsets_.x) + n / root);
    const float v = fraction(static_cast<double>(offsets_.y) + n / (root * root));
    const float p = fraction(static_cast<double>(offsets_.z) + n / (root * root * root));
    const float q = fraction(static_cast<double>(offsets_.w) + n / (root * root * root * root));
    const std::uint32_t side = side_within(patch, u);
    const Corners at = corners_of(side_triangle_[side]);
    const float root_u = std::sqrt(u);
    glm::vec3 origin = at.a * (1.0F - root_u) + at.b * (root_u * (1.0F - v)) + at.c * (root_u * v);
    glm::vec3 facing = normals_[patch];
    if (!sets_.empty()) {
        const glm::vec3 across = glm::cross(at.b - at.a, at.c - at.a);
        facing = across * ((side < triangles_.size() ? 1.0F : -1.0F) /
                           std::max(glm::length(across), 1e-30F));
    }
    origin += lift_ * facing;
    result.origin = origin;
    const glm::vec3 direction = cosine_direction(facing, p, q);
    result.area = static_cast<float>(static_cast<double>(areas_[patch]) /
                                     (shares_[patch] * static_cast<double>(starts_.size())));
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    RTCRayHit hit{};
    hit.ray.org_x = origin.x;
    hit.ray.org_y = origin.y;
    hit.ray.org_z = origin.z;
    hit.ray.dir_x = direction.x;
    hit.ray.dir_y = direction.y;
    hit.ray.dir_z = direction.z;
    hit.ray.mask = ~0U;
    hit.ray.tnear = 0.0F;
    for (int pass = 0; pass < max_passes; ++pass) {
        hit.ray.tfar = INFINITY;
        hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(rays_.get(), &context, &hit);
        if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
            result.towards = direction;
            result.left_by_air = static_cast<float>(left_by_air(hit, false));
            look_up_sky(result);
            return result;
        }
        const std::uint32_t triangle = hit.hit.primID;
        const glm::vec3 normal(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z);
        const float along = glm::dot(normal, direction);
        const bool front = along < 0.0F;
        const std::uint32_t material = triangle_material_[triangle];
        const std::uint32_t received = front ? triangle : back_side_[triangle];
        const float chance =
            random_number(number * max_passes + static_cast<std::uint64_t>(pass) + 1);
        bool passes = !coverage_.empty() && chance >= coverage_[triangle];
        if (is_glass_[material]) {
            const float cosine = std::abs(along) / std::max(glm::length(normal), 1e-30F);
            if (chance >= glass_[material].passing_share(cosine)) {
                return result;
            }
            passes = true;
        }
        if (!passes && scene_.medium &&
            static_cast<double>(random_number(~number)) >= left_by_air(hit, true)) {
            return result;
        }
        if (!passes && received == PatchMesh::no_patch) {
            result.to = front_beside(hit);
            return result;
        }
        if (!passes) {
            result.to = patch_of(received);
            return result;
        }
        hit.ray.tnear = hit.ray.tfar + lift_;
    }
    return result;
}

/// Share of a ray's light that is left where it has met something, or beyond the scene.
double ExchangeRays::left_by_air(const RTCRayHit& hit, bool met) const {
    if (!scene_.medium) {
        return 1.0;
    }
    const glm::dvec3 centre(scene_.bounds.centre());
    const WayInBox way =
        way_in_box(glm::dvec3(scene_.bounds.min) - centre, glm::dvec3(scene_.bounds.max) - centre,
                   {hit.ray.org_x, hit.ray.org_y, hit.ray.org_z},
                   {hit.ray.dir_x, hit.ray.dir_y, hit.ray.dir_z},
                   met ? static_cast<double>(hit.ray.tfar) : INFINITY);
    return scene_.medium->left_after(way.length());
}

/// Among coinciding surfaces the one that faces the ray wins, as in bundles. Returns its patch
/// where a ray has met a back, or lost where there is none.
std::uint32_t ExchangeRays::front_beside(const RTCRayHit& back) const {
    Query query;
    rtcInitIntersectContext(&query.context);
    query.context.filter = &ExchangeRays::reject_backs;
    query.rays = this;
    RTCRayHit hit = back;
    hit.ray.tnear = std::max(back.ray.tfar - tie_lifts * lift_, 0.0F);
    hit.ray.tfar = back.ray.tfar + tie_lifts * lift_;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(rays_.get(), &query.context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return ExchangeRay::lost;
    }
    const float along =
        hit.hit.Ng_x * hit.ray.dir_x + hit.hit.Ng_y * hit.ray.dir_y + hit.hit.Ng_z * hit.ray.dir_z;
    return patch_of(along < 0.0F ? hit.hit.primID : back_side_[hit.hit.primID]);
}

std::vector<ExchangeRay> ExchangeRays::trace() const {
    std::vector<ExchangeRay> rays(starts_.size());
    constexpr std::size_t grain = 1024;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rays.size(), grain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t i = range.begin(); i < range.end(); ++i) {
                              rays[i] = follow(starts_[i], i);
                          }
                      });
    return rays;
}

}  // namespace raybundle
