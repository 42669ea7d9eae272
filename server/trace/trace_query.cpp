// SPDX-License-Identifier: Apache-2.0
#include "trace/trace_query.h"

#include <algorithm>
#include <cmath>

namespace raybundle {

namespace {

/// One ray of a filter's arguments.
struct Filtered {
    const RTCFilterFunctionNArguments* arguments;
    unsigned i;

    [[nodiscard]] glm::vec3 normal() const {
        RTCHitN* const hit = arguments->hit;
        const unsigned n = arguments->N;
        return {RTCHitN_Ng_x(hit, n, i), RTCHitN_Ng_y(hit, n, i), RTCHitN_Ng_z(hit, n, i)};
    }
    [[nodiscard]] glm::vec3 direction() const {
        RTCRayN* const ray = arguments->ray;
        const unsigned n = arguments->N;
        return {RTCRayN_dir_x(ray, n, i), RTCRayN_dir_y(ray, n, i), RTCRayN_dir_z(ray, n, i)};
    }
    [[nodiscard]] unsigned geometry() const {
        return RTCHitN_geomID(arguments->hit, arguments->N, i);
    }
    [[nodiscard]] unsigned primitive() const {
        return RTCHitN_primID(arguments->hit, arguments->N, i);
    }
    [[nodiscard]] std::uint32_t line() const { return RTCRayN_id(arguments->ray, arguments->N, i); }
    [[nodiscard]] float way() const { return RTCRayN_tfar(arguments->ray, arguments->N, i); }
    [[nodiscard]] glm::vec2 weights() const {
        return {RTCHitN_u(arguments->hit, arguments->N, i),
                RTCHitN_v(arguments->hit, arguments->N, i)};
    }
};

/// Whether a ray passes the surface, or the part is at another place than the ray sees.
bool goes_on(const Query& query, const Filtered& ray) {
    const FacetTreeScene::Part& part = query.tree->part(ray.geometry());
    if (part.in_motion && part.place != query.rules->place) {
        return true;
    }
    if (!part.may_pass) {
        return false;
    }
    const std::uint32_t facet = part.facets[ray.primitive()];
    const std::uint32_t material = query.tree->material(facet);
    if (!part.uvs.empty()) {
        const glm::uvec3& corners = part.corners[ray.primitive()];
        const glm::vec2 w = ray.weights();
        const glm::vec2 uv = (1.0F - w.x - w.y) * part.uvs[corners.x] + w.x * part.uvs[corners.y] +
                             w.y * part.uvs[corners.z];
        if (query.openings->cut_out(material, uv)) {
            return true;
        }
    }
    const glm::vec3 normal = ray.normal();
    const glm::vec3 direction = ray.direction();
    const float lengths = std::sqrt(glm::dot(normal, normal) * glm::dot(direction, direction));
    const float cosine =
        std::min(std::abs(glm::dot(normal, direction)) / std::max(lengths, 1e-30F), 1.0F);
    return query.openings->passes(material, facet, cosine, *query.rules, ray.line());
}

}  // namespace

void filter_part(const RTCFilterFunctionNArguments* arguments) {
    const auto& query = *reinterpret_cast<const Query*>(arguments->context);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] != 0 && goes_on(query, {arguments, i})) {
            arguments->valid[i] = 0;
        }
    }
}

void filter_query(const RTCFilterFunctionNArguments* arguments) {
    const auto& query = *reinterpret_cast<const Query*>(arguments->context);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) {
            continue;
        }
        const Filtered ray{arguments, i};
        const bool back = glm::dot(ray.normal(), ray.direction()) >= 0.0F;
        const auto object = [&] {
            return query.tree->object(query.tree->part(ray.geometry()).facets[ray.primitive()]);
        };
        if ((query.fronts_only && back) ||
            (!query.hidden.empty() &&
             std::find(query.hidden.begin(), query.hidden.end(), object()) != query.hidden.end())) {
            arguments->valid[i] = 0;
        }
    }
}

void filter_lines(const RTCFilterFunctionNArguments* arguments) {
    const auto& query = *reinterpret_cast<const Query*>(arguments->context);
    PacketLines& lines = *query.lines;
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) {
            continue;
        }
        const Filtered ray{arguments, i};
        const std::uint32_t number = ray.line();
        const int column = static_cast<int>(number & 0xffffU) - lines.first.x;
        const int row = static_cast<int>(number >> 16U) - lines.line_row - lines.first.y;
        const glm::vec3 normal = ray.normal();
        const bool along = glm::dot(normal, ray.direction()) > 0.0F;
        const std::uint32_t facet = query.tree->part(ray.geometry()).facets[ray.primitive()];
        const int line = row * lines.columns + column;
        lines.lines[static_cast<std::size_t>(line)].push_back(
            {ray.way(), 2 * facet + (along ? 0U : 1U), normal});
        arguments->valid[i] = 0;
    }
}

void filter_shadow(const RTCFilterFunctionNArguments* arguments) {
    const auto& query = *reinterpret_cast<const Query*>(arguments->context);
    for (unsigned i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) {
            continue;
        }
        const Filtered ray{arguments, i};
        const glm::vec3 normal = ray.normal();
        const float height = std::abs(glm::dot(normal, ray.direction())) * ray.way();
        const bool own =
            query.tree->part(ray.geometry()).facets[ray.primitive()] == query.own_facet;
        if (own || height <= query.tie * glm::length(normal)) {
            arguments->valid[i] = 0;
        }
    }
}

}  // namespace raybundle
