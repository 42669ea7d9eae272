// SPDX-License-Identifier: Apache-2.0
// EdgeRefinement's cuts along contact lines.
#include <algorithm>
#include <cmath>

#include "scene/mesh/edge_refinement.h"

namespace raybundle {
namespace {

/// Part of the way from a to b. Both neighbours of an edge name its ends in the same order and get
/// the same bits.
EdgeRefinement::Shading between(const EdgeRefinement::Shading& a, const EdgeRefinement::Shading& b,
                                float part) {
    const glm::vec3 normal = glm::mix(a.normal, b.normal, part);
    const float length = glm::length(normal);
    return {length > 1e-6F ? normal / length : a.normal, glm::mix(a.uv, b.uv, part),
            glm::mix(a.colour, b.colour, part)};
}

}  // namespace

void EdgeRefinement::cut(std::span<const ContactLine> lines, double resolution) {
    std::vector<std::size_t> first(triangles_.size() + 1, 0);  // line of each triangle
    std::vector<bool> components(component_object_.size(), false);
    for (const ContactLine& line : lines) {
        ++first[line.triangle + 1];
        components[component_of(triangles_[line.triangle])] = true;
    }
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        first[t + 1] += first[t];
    }
    Work work = take(components);
    // In each round every piece is cut once at most, along the first line that crosses it and that
    // agrees with its neighbours' cuts; a piece remembers in `node` what it is a piece of. A line
    // that had to give way comes again in a later round.
    bool any_cut = !lines.empty();
    for (std::size_t round = 0; any_cut && round < 2 * max_contact_lines; ++round) {
        Edges edges = find_edges(work.triangles);
        Parts parts(edges.points.size(), 0.0F);
        any_cut = false;
        for (std::size_t t = 0; t < work.triangles.size(); ++t) {
            const std::uint32_t origin = work.triangles[t].node;
            bool cut = false;
            for (std::size_t i = first[origin]; i < first[origin + 1] && !cut; ++i) {
                cut = mark_crossings(edges.of_triangle[t], lines[i], resolution, edges, parts);
            }
            any_cut = any_cut || cut;
        }
        Work divided;
        for (std::size_t t = 0; t < work.triangles.size(); ++t) {
            add_divided(work.triangles[t], edges.of_triangle[t], edges, parts, divided.triangles);
            divided.places.resize(divided.triangles.size(), work.places[t]);
        }
        work = std::move(divided);
    }
    put_back(std::move(work));
    begin_refinement();
}

/// Splits the edges of a triangle that a line crosses. False, with nothing done, where it crosses
/// none or a neighbour's line has split one elsewhere.
bool EdgeRefinement::mark_crossings(const std::array<std::uint32_t, 3>& numbers,
                                    const ContactLine& line, double resolution, Edges& edges,
                                    Parts& parts) {
    const auto distance = [&](std::uint32_t point) {
        const double d = line.distance(world_point(point));
        return std::abs(d) <= resolution ? 0.0 : d;
    };
    const auto is_crossed = [&](std::uint32_t edge) {
        return distance(edges.points[edge][0]) * distance(edges.points[edge][1]) < 0.0;
    };
    const bool crossed = std::any_of(numbers.begin(), numbers.end(), is_crossed);
    const bool agreed = std::all_of(numbers.begin(), numbers.end(), [&](std::uint32_t edge) {
        const std::uint32_t at = edges.midpoint[edge];
        return at == no_point || (is_crossed(edge) && distance(at) == 0.0);
    });
    if (!crossed || !agreed) {
        return false;
    }
    for (const std::uint32_t edge : numbers) {
        if (is_crossed(edge) && edges.midpoint[edge] == no_point) {
            const auto [a, b] = edges.points[edge];
            const double from_a = line.distance(world_point(a));
            const double part = from_a / (from_a - line.distance(world_point(b)));
            parts[edge] = static_cast<float>(part);
            edges.midpoint[edge] =
                add_point(point_component_[a], glm::mix(points_[a], points_[b], parts[edge]));
        }
    }
    return true;
}

/// Appends the pieces of a triangle whose edges are split. numbers: of its edges,
/// no_edge for those that a split has made.
void EdgeRefinement::add_divided(const RefinedTriangle& triangle,
                                 const std::array<std::uint32_t, 3>& numbers, const Edges& edges,
                                 const Parts& parts, std::vector<RefinedTriangle>& result) {
    const auto split = std::find_if(numbers.begin(), numbers.end(), [&](std::uint32_t edge) {
        return edge != no_edge && edges.midpoint[edge] != no_point;
    });
    if (split == numbers.end()) {
        result.push_back(triangle);
        return;
    }
    const auto k = static_cast<std::size_t>(split - numbers.begin());
    const Corner& p = triangle.corners[k];
    const Corner& q = triangle.corners[(k + 1) % 3];
    const Corner& r = triangle.corners[(k + 2) % 3];
    const bool forward = edges.points[*split][0] == p.point;
    const Shading at_p = shading(p.shading);
    const Shading at_q = shading(q.shading);
    const Corner m = {
        edges.midpoint[*split],
        add_shading(between(forward ? at_p : at_q, forward ? at_q : at_p, parts[*split]))};
    RefinedTriangle half = triangle;
    half.corners = {p, m, r};
    add_divided(half, {no_edge, no_edge, numbers[(k + 2) % 3]}, edges, parts, result);
    half.corners = {m, q, r};
    add_divided(half, {no_edge, numbers[(k + 1) % 3], no_edge}, edges, parts, result);
}

}  // namespace raybundle
