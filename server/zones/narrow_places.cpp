// SPDX-License-Identifier: Apache-2.0
// Rays from sheltered surfaces, and where they pass others closely.
#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "scene/triangle_corners.h"
#include "zones/exchange_rays.h"

namespace raybundle {

namespace {

struct Triangles {
    std::span<const glm::vec3> vertices;
    std::span<const glm::uvec3> triangles;
};

bool look_at_triangle(RTCPointQueryFunctionArguments* arguments) {
    const auto& [vertices, triangles] = *static_cast<const Triangles*>(arguments->userPtr);
    const glm::uvec3& corners = triangles[arguments->primID];
    RTCPointQuery& query = *arguments->query;
    const glm::vec3 point(query.x, query.y, query.z);
    const float distance = glm::distance(
        point,
        nearest_point({vertices[corners.x], vertices[corners.y], vertices[corners.z]}, point));
    if (distance >= query.radius) {
        return false;
    }
    query.radius = distance;
    return true;
}

}  // namespace

std::vector<ExchangeRay> ExchangeRays::trace_from(std::span<const std::uint32_t> patches,
                                                  std::size_t count) const {
    std::vector<double> until;  // area of the patches so far, m²
    double area = 0.0;
    for (const std::uint32_t patch : patches) {
        area += static_cast<double>(areas_[patch]);
        until.push_back(area);
    }
    std::vector<ExchangeRay> rays(area > 0.0 ? count : 0);
    tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) {
        const double at = area * (static_cast<double>(i) + 0.5) / static_cast<double>(count);
        const auto found = std::upper_bound(until.begin(), until.end(), at);
        const auto k = std::min(static_cast<std::size_t>(found - until.begin()), until.size() - 1);
        rays[i] = follow(patches[k], starts_.size() + i);
        rays[i].area = static_cast<float>(area / static_cast<double>(count));
    });
    return rays;
}

std::optional<glm::vec3> ExchangeRays::last_narrow_place(const ExchangeRay& ray) const {
    constexpr int max_steps = 128;
    constexpr float shortest_step = 0.02F;  // of the way from the origin
    constexpr float narrow = 0.8F;          // of the room before
    Triangles surfaces{vertices_, triangles_};
    float way = 64.0F * lift_;
    float bound = 1e30F;  // no surface is farther
    float widest = 0.0F;
    float narrowest = 1e30F;  // since then
    float at = 0.0F;
    std::optional<float> found;
    for (int step = 0; step < max_steps && way < diameter_; ++step) {
        const glm::vec3 point = ray.origin + way * ray.towards;
        RTCPointQuery query{point.x, point.y, point.z, 0.0F, bound};
        RTCPointQueryContext context;
        rtcInitPointQueryContext(&context);
        rtcPointQuery(rays_.get(), &query, &context, look_at_triangle, &surfaces);
        const float clear = query.radius;
        if (clear > widest) {
            found = narrowest < narrow * widest ? at : found;
            widest = clear;
            narrowest = 1e30F;
        } else if (clear < narrowest) {
            narrowest = clear;
            at = way;
        }
        const float advance = std::max(0.5F * clear, shortest_step * way);
        way += advance;
        bound = clear + advance;
    }
    if (!found) {
        return std::nullopt;
    }
    return ray.origin + *found * ray.towards;
}

}  // namespace raybundle
