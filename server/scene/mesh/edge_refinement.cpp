// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/edge_refinement.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "scene/contact/point_index.h"
#include "scene/disjoint_sets.h"

namespace raybundle {
namespace {

/// Numbers pairs of points in the order of their first use: an open-addressing hash table, as this
/// is where tessellation spends its time.
class EdgeTable {
  public:
    explicit EdgeTable(std::size_t max_edges)
        : slots_(std::bit_ceil(max_edges + max_edges / 3 + 2), EdgeRefinement::no_edge),
          mask_(slots_.size() - 1) {}

    /// Number of the edge, and whether it is new and has been added to `edges`, its two points.
    std::pair<std::uint32_t, bool> number_of(std::uint32_t low, std::uint32_t high,
                                             std::vector<std::array<std::uint32_t, 2>>& edges) {
        const std::array<std::uint32_t, 2> edge = {low, high};
        const std::uint64_t key = (std::uint64_t{low} << 32U) | high;
        for (std::size_t at = mix_bits(key) & mask_;; at = (at + 1) & mask_) {
            if (slots_[at] == EdgeRefinement::no_edge) {
                slots_[at] = static_cast<std::uint32_t>(edges.size());
                edges.push_back(edge);
                return {slots_[at], true};
            }
            if (edges[slots_[at]] == edge) {
                return {slots_[at], false};
            }
        }
    }

  private:
    std::vector<std::uint32_t> slots_;
    std::size_t mask_;
};

/// The triangles at each edge: of edge e, triangles[first[e]] to triangles[first[e + 1]].
struct EdgeTriangles {
    std::vector<std::uint32_t> first, triangles;
};

EdgeTriangles triangles_at_edges(const std::vector<std::array<std::uint32_t, 3>>& of_triangle,
                                 std::size_t edge_count) {
    EdgeTriangles result{std::vector<std::uint32_t>(edge_count + 1, 0),
                         std::vector<std::uint32_t>(of_triangle.size() * 3)};
    for (const auto& edges : of_triangle) {
        for (const std::uint32_t edge : edges) {
            ++result.first[edge + 1];
        }
    }
    for (std::size_t e = 0; e < edge_count; ++e) {
        result.first[e + 1] += result.first[e];
    }
    std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
    for (std::size_t t = 0; t < of_triangle.size(); ++t) {
        for (const std::uint32_t edge : of_triangle[t]) {
            result.triangles[next[edge]++] = static_cast<std::uint32_t>(t);
        }
    }
    return result;
}

EdgeRefinement::Shading midway(const EdgeRefinement::Shading& a, const EdgeRefinement::Shading& b) {
    // Sums commute, so that both neighbours of the edge get the same bits.
    const glm::vec3 sum = a.normal + b.normal;
    const float length = glm::length(sum);
    return {length > 1e-6F ? sum / length : a.normal, 0.5F * (a.uv + b.uv),
            0.5F * (a.colour + b.colour)};
}

std::size_t sides_of(const EdgeRefinement::RefinedTriangle& triangle) {
    return triangle.two_sided ? 2 : 1;
}

std::size_t sides_of(const std::vector<EdgeRefinement::RefinedTriangle>& triangles) {
    std::size_t count = 0;
    for (const EdgeRefinement::RefinedTriangle& triangle : triangles) {
        count += sides_of(triangle);
    }
    return count;
}

/// Sides that there are once the marked edges are split.
std::size_t sides_after(const std::vector<EdgeRefinement::RefinedTriangle>& triangles,
                        const std::vector<std::array<std::uint32_t, 3>>& edges_of_triangle,
                        const std::vector<bool>& marked) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
        std::size_t pieces = 1;
        for (const std::uint32_t edge : edges_of_triangle[t]) {
            pieces += marked[edge] ? 1 : 0;
        }
        count += pieces * sides_of(triangles[t]);
    }
    return count;
}

}  // namespace

EdgeRefinement::EdgeRefinement(const Scene& scene) : scene_(&scene) {
    for (const Object& object : scene.objects) {
        world_from_object_.emplace_back(object.world_from_object());
    }
    std::vector<PointIndex> numbers(scene.objects.size());
    std::vector<std::vector<std::uint32_t>> global(scene.objects.size());
    triangles_.reserve(scene.triangles.size());
    for (const Triangle& triangle : scene.triangles) {
        RefinedTriangle refined;
        refined.material = triangle.material;
        refined.object = triangle.object;
        refined.two_sided = two_sided(scene, triangle);
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3& position = scene.vertices[triangle.vertex[k]].position;
            const std::uint32_t local = numbers[triangle.object].id_of(position);
            if (local == global[triangle.object].size()) {
                global[triangle.object].push_back(static_cast<std::uint32_t>(points_.size()));
                // -0 becomes 0, so that equal corners have equal bits.
                points_.push_back(position + 0.0F);
                component_object_.push_back(triangle.object);
            }
            refined.corners[k] = {global[triangle.object][local], triangle.vertex[k]};
        }
        triangles_.push_back(refined);
    }
    join_points();
    nodes_.resize(triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        triangles_[t].node = static_cast<std::uint32_t>(t);
    }
    begin_refinement();
}

void EdgeRefinement::join_points() {
    DisjointSets components(points_.size());
    for (const RefinedTriangle& triangle : triangles_) {
        components.join(triangle.corners[0].point, triangle.corners[1].point);
        components.join(triangle.corners[0].point, triangle.corners[2].point);
    }
    point_component_.reserve(points_.size());
    for (std::uint32_t point = 0; point < points_.size(); ++point) {
        point_component_.push_back(components.find(point));
    }
}

/// What the triangles are now is what is unrefined. A triangle has in `node` what it is a piece of.
void EdgeRefinement::begin_refinement() {
    unrefined_.reset();
    auto unrefined = std::make_shared<Unrefined>();
    unrefined->origins.reserve(triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        unrefined->origins.push_back(triangles_[t].node);
        triangles_[t].node = static_cast<std::uint32_t>(t);
    }
    unrefined->points = points_.size();
    unrefined->shadings = shadings_.size();
    unrefined->patches = sides_of(triangles_);
    unrefined->triangles = std::move(triangles_);
    unrefined_ = std::move(unrefined);
    restart();
}

void EdgeRefinement::restart() {
    triangles_ = unrefined_->triangles;
    nodes_.assign(triangles_.size(), Node{});
    points_.resize(unrefined_->points);
    point_component_.resize(unrefined_->points);
    shadings_.resize(unrefined_->shadings);
    patch_count_ = unrefined_->patches;
}

EdgeRefinement::Work EdgeRefinement::take(const std::vector<bool>& components) const {
    Work work;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
        if (components[component_of(triangles_[t])]) {
            work.triangles.push_back(triangles_[t]);
            work.places.push_back(t);
        }
    }
    return work;
}

/// Pieces take the places of what they are pieces of, in order.
void EdgeRefinement::put_back(Work work) {
    std::vector<RefinedTriangle> all;
    all.reserve(triangles_.size() + work.triangles.size());
    std::size_t next = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        if (next == work.places.size() || work.places[next] != t) {
            all.push_back(triangles_[t]);
            continue;
        }
        for (; next < work.places.size() && work.places[next] == t; ++next) {
            all.push_back(work.triangles[next]);
        }
    }
    triangles_ = std::move(all);
}

/// Triangles in components where some edge is too long.
EdgeRefinement::Work EdgeRefinement::longer_than(double target_edge) const {
    std::vector<bool> components(component_object_.size(), false);
    for (const RefinedTriangle& triangle : triangles_) {
        const double longest = triangle.small ? 2.0 * target_edge : target_edge;
        const auto [a, b, c] = world_corners(triangle);
        const double squared =
            std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
        if (squared > longest * longest) {
            components[component_of(triangle)] = true;
        }
    }
    return take(components);
}

bool EdgeRefinement::refine(double target_edge, std::size_t max_patches) {
    Work work = longer_than(target_edge);
    const std::size_t others = patch_count_ - sides_of(work.triangles);
    bool done = false;
    while (!done && patch_count_ <= max_patches) {
        Edges edges = find_edges(work.triangles);
        std::vector<bool> marked(edges.points.size(), false);
        for (std::size_t t = 0; t < work.triangles.size(); ++t) {
            const double longest = work.triangles[t].small ? 2.0 * target_edge : target_edge;
            for (const std::uint32_t edge : edges.of_triangle[t]) {
                marked[edge] = marked[edge] || edges.squared_length[edge] > longest * longest;
            }
        }
        done = std::find(marked.begin(), marked.end(), true) == marked.end();
        if (done) {
            break;
        }
        mark_longest(edges, marked);
        patch_count_ = others + sides_after(work.triangles, edges.of_triangle, marked);
        if (patch_count_ <= max_patches) {
            add_midpoints(marked, edges);
            split_triangles(edges, work);
        }
    }
    put_back(std::move(work));
    return done;
}

void EdgeRefinement::mark_small(const std::vector<bool>& small) {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        triangles_[t].small = small[t];
    }
}

bool EdgeRefinement::split(const std::vector<bool>& chosen, std::size_t max_patches) {
    std::vector<bool> components(component_object_.size(), false);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        if (chosen[t]) {
            components[component_of(triangles_[t])] = true;
        }
    }
    Work work = take(components);
    Edges edges = find_edges(work.triangles);
    std::vector<bool> marked(edges.points.size(), false);
    for (std::size_t t = 0; t < work.triangles.size(); ++t) {
        if (chosen[work.places[t]]) {
            marked[edges.of_triangle[t][longest_edge(edges, t)]] = true;
            work.triangles[t].small = false;
        }
    }
    mark_longest(edges, marked);
    const std::size_t count = patch_count_ - sides_of(work.triangles) +
                              sides_after(work.triangles, edges.of_triangle, marked);
    if (count > max_patches) {
        return false;
    }
    patch_count_ = count;
    add_midpoints(marked, edges);
    split_triangles(edges, work);
    put_back(std::move(work));
    return true;
}

std::array<glm::dvec3, 3> EdgeRefinement::world_corners(const RefinedTriangle& triangle) const {
    return {world_point(triangle.corners[0].point), world_point(triangle.corners[1].point),
            world_point(triangle.corners[2].point)};
}

glm::dvec3 EdgeRefinement::world_point(std::uint32_t point) const {
    const glm::dmat4& world = world_from_object_[component_object_[point_component_[point]]];
    return {world * glm::dvec4(glm::dvec3(points_[point]), 1.0)};
}

double EdgeRefinement::squared_length(std::uint32_t low, std::uint32_t high) const {
    const glm::dvec3 along = world_point(high) - world_point(low);
    return glm::dot(along, along);
}

EdgeRefinement::Shading EdgeRefinement::shading(std::uint32_t number) const {
    if (number >= scene_->vertices.size()) {
        return shadings_[number - scene_->vertices.size()];
    }
    // -0 becomes 0, so that equal corners have equal bits.
    const Vertex& vertex = scene_->vertices[number];
    return {vertex.normal + 0.0F, vertex.uv + 0.0F, vertex.colour + 0.0F};
}

std::uint32_t EdgeRefinement::add_shading(const Shading& shading) {
    shadings_.push_back(shading);
    return static_cast<std::uint32_t>(scene_->vertices.size() + shadings_.size() - 1);
}

EdgeRefinement::Edges EdgeRefinement::find_edges(
    const std::vector<RefinedTriangle>& triangles) const {
    Edges edges;
    EdgeTable table(triangles.size() * 3);
    edges.of_triangle.reserve(triangles.size());
    for (const RefinedTriangle& triangle : triangles) {
        std::array<std::uint32_t, 3> numbers{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = triangle.corners[k].point;
            const std::uint32_t b = triangle.corners[(k + 1) % 3].point;
            const std::uint32_t low = std::min(a, b);
            const std::uint32_t high = std::max(a, b);
            const auto [number, is_new] = table.number_of(low, high, edges.points);
            if (is_new) {
                edges.squared_length.push_back(squared_length(low, high));
            }
            numbers[k] = number;
        }
        edges.of_triangle.push_back(numbers);
    }
    edges.midpoint.assign(edges.points.size(), no_point);
    return edges;
}

/// Ties go to the edge with the smaller number: then neighbours agree, and marking cannot run in
/// circles.
std::size_t EdgeRefinement::longest_edge(const Edges& edges, std::size_t triangle) {
    const std::array<std::uint32_t, 3>& e = edges.of_triangle[triangle];
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        const double difference = edges.squared_length[e[k]] - edges.squared_length[e[longest]];
        if (difference > 0.0 || (difference == 0.0 && e[k] < e[longest])) {
            longest = k;
        }
    }
    return longest;
}

/// Marks with any edge of a triangle also its longest one.
void EdgeRefinement::mark_longest(const Edges& edges, std::vector<bool>& marked) {
    std::vector<std::uint32_t> pending;
    for (std::size_t e = 0; e < marked.size(); ++e) {
        if (marked[e]) {
            pending.push_back(static_cast<std::uint32_t>(e));
        }
    }
    const EdgeTriangles at = triangles_at_edges(edges.of_triangle, edges.points.size());
    while (!pending.empty()) {
        const std::uint32_t edge = pending.back();
        pending.pop_back();
        for (std::uint32_t i = at.first[edge]; i < at.first[edge + 1]; ++i) {
            const std::size_t triangle = at.triangles[i];
            const std::uint32_t longest =
                edges.of_triangle[triangle][longest_edge(edges, triangle)];
            if (!marked[longest]) {
                marked[longest] = true;
                pending.push_back(longest);
            }
        }
    }
}

void EdgeRefinement::add_midpoints(const std::vector<bool>& marked, Edges& edges) {
    for (std::size_t e = 0; e < marked.size(); ++e) {
        if (!marked[e]) {
            continue;
        }
        const auto [a, b] = edges.points[e];
        edges.midpoint[e] = add_point(point_component_[a], 0.5F * (points_[a] + points_[b]));
    }
}

std::uint32_t EdgeRefinement::add_point(std::uint32_t component, const glm::vec3& position) {
    const auto number = static_cast<std::uint32_t>(points_.size());
    points_.push_back(position);
    point_component_.push_back(component);
    return number;
}

std::array<EdgeRefinement::RefinedTriangle, 2> EdgeRefinement::split(
    const RefinedTriangle& triangle, std::size_t edge, std::uint32_t midpoint) {
    const Corner& p = triangle.corners[edge];
    const Corner& q = triangle.corners[(edge + 1) % 3];
    const Corner& r = triangle.corners[(edge + 2) % 3];
    const Corner m = {midpoint, add_shading(midway(shading(p.shading), shading(q.shading)))};
    const auto first = static_cast<std::uint32_t>(nodes_.size());
    nodes_[triangle.node] = {static_cast<std::uint8_t>(edge), first};
    nodes_.resize(nodes_.size() + 2);
    std::array<RefinedTriangle, 2> halves = {triangle, triangle};
    halves[0].corners = {p, m, r};
    halves[0].node = first;
    halves[1].corners = {m, q, r};
    halves[1].node = first + 1;
    return halves;
}

/// Bisects the longest edge, then each half whose own outer edge is marked.
void EdgeRefinement::split_triangles(const Edges& edges, Work& work) {
    constexpr std::array<std::size_t, 2> outer_edge = {2, 1};  // of the two halves
    Work refined;
    const auto add = [&](const RefinedTriangle& triangle, std::uint32_t place) {
        refined.triangles.push_back(triangle);
        refined.places.push_back(place);
    };
    for (std::size_t t = 0; t < work.triangles.size(); ++t) {
        const std::uint32_t place = work.places[t];
        const std::size_t longest = longest_edge(edges, t);
        const auto midpoint = [&](std::size_t k) {
            return edges.midpoint[edges.of_triangle[t][(longest + k) % 3]];
        };
        if (midpoint(0) == no_point) {
            add(work.triangles[t], place);
            continue;
        }
        const auto halves = split(work.triangles[t], longest, midpoint(0));
        for (std::size_t h = 0; h < halves.size(); ++h) {
            const std::uint32_t outer = midpoint(outer_edge[h]);
            if (outer == no_point) {
                add(halves[h], place);
                continue;
            }
            for (const RefinedTriangle& quarter : split(halves[h], outer_edge[h], outer)) {
                add(quarter, place);
            }
        }
    }
    work = std::move(refined);
}

}  // namespace raybundle
