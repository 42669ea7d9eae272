// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/edge_refinement.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "scene/contact/point_index.h"

namespace raybundle {
namespace {

/// Numbers pairs of points in the order of their first use: an open-addressing hash table, as this
/// is where tessellation spends its time.
class EdgeTable {
  public:
    explicit EdgeTable(std::size_t max_edges)
        : slots_(std::bit_ceil(2 * max_edges + 2)), mask_(slots_.size() - 1) {}

    /// Number of the edge, and whether it is new.
    std::pair<std::uint32_t, bool> number_of(std::uint32_t low, std::uint32_t high) {
        const std::uint64_t key = (std::uint64_t{low} << 32U) | high;
        for (std::size_t at = mix_bits(key) & mask_;; at = (at + 1) & mask_) {
            if (slots_[at].number == EdgeRefinement::no_edge) {
                slots_[at] = {key, count_};
                return {count_++, true};
            }
            if (slots_[at].key == key) {
                return {slots_[at].number, false};
            }
        }
    }

  private:
    struct Slot {
        std::uint64_t key = 0;
        std::uint32_t number = EdgeRefinement::no_edge;
    };
    std::vector<Slot> slots_;
    std::size_t mask_;
    std::uint32_t count_ = 0;
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

EdgeRefinement::Corner midway(const EdgeRefinement::Corner& a, const EdgeRefinement::Corner& b,
                              std::uint32_t point) {
    // Sums commute, so that both neighbours of the edge get the same bits.
    const glm::vec3 sum = a.normal + b.normal;
    const float length = glm::length(sum);
    return {point, length > 1e-6F ? sum / length : a.normal, 0.5F * (a.uv + b.uv),
            0.5F * (a.colour + b.colour)};
}

}  // namespace

EdgeRefinement::EdgeRefinement(const Scene& scene) {
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
            const Vertex& vertex = scene.vertices[triangle.vertex[k]];
            const std::uint32_t local = numbers[triangle.object].id_of(vertex.position);
            if (local == global[triangle.object].size()) {
                global[triangle.object].push_back(
                    add_point(triangle.object, vertex.position + 0.0F));
            }
            // -0 becomes 0, so that equal corners have equal bits.
            refined.corners[k] = {global[triangle.object][local], vertex.normal + 0.0F,
                                  vertex.uv + 0.0F, vertex.colour + 0.0F};
        }
        triangles_.push_back(refined);
    }
    begin_refinement();
}

/// What the triangles are now is what is unrefined.
void EdgeRefinement::begin_refinement() {
    nodes_.assign(triangles_.size(), Node{});
    patch_count_ = 0;
    const bool cut = !origins_.empty();  // then a piece has in `node` what it is a piece of
    origins_.clear();
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        origins_.push_back(cut ? triangles_[t].node : static_cast<std::uint32_t>(t));
        triangles_[t].node = static_cast<std::uint32_t>(t);
        patch_count_ += triangles_[t].two_sided ? 2 : 1;
    }
    unrefined_ = triangles_;
}

bool EdgeRefinement::refine(double target_edge, std::size_t max_patches) {
    while (patch_count_ <= max_patches) {
        Edges edges = find_edges();
        std::vector<bool> marked(edges.points.size(), false);
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            const double longest = triangles_[t].small ? 2.0 * target_edge : target_edge;
            for (const std::uint32_t edge : edges.of_triangle[t]) {
                marked[edge] = marked[edge] || edges.squared_length[edge] > longest * longest;
            }
        }
        if (std::find(marked.begin(), marked.end(), true) == marked.end()) {
            return true;
        }
        mark_longest(edges, marked);
        patch_count_ = patches_after(edges, marked);
        if (patch_count_ <= max_patches) {
            add_midpoints(marked, edges);
            split_triangles(edges);
        }
    }
    return false;
}

void EdgeRefinement::mark_small(const std::vector<bool>& small) {
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        triangles_[t].small = small[t];
    }
}

bool EdgeRefinement::split(const std::vector<bool>& chosen, std::size_t max_patches) {
    Edges edges = find_edges();
    std::vector<bool> marked(edges.points.size(), false);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        if (chosen[t]) {
            marked[edges.of_triangle[t][static_cast<std::size_t>(longest_edge(edges, t))]] = true;
        }
    }
    mark_longest(edges, marked);
    const std::size_t count = patches_after(edges, marked);
    if (count > max_patches) {
        return false;
    }
    patch_count_ = count;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        triangles_[t].small = triangles_[t].small && !chosen[t];
    }
    add_midpoints(marked, edges);
    split_triangles(edges);
    return true;
}

std::array<glm::dvec3, 3> EdgeRefinement::world_corners(const RefinedTriangle& triangle) const {
    return {world_points_[triangle.corners[0].point], world_points_[triangle.corners[1].point],
            world_points_[triangle.corners[2].point]};
}

EdgeRefinement::Edges EdgeRefinement::find_edges() const {
    Edges edges;
    EdgeTable table(triangles_.size() * 3);
    edges.of_triangle.reserve(triangles_.size());
    for (const RefinedTriangle& triangle : triangles_) {
        std::array<std::uint32_t, 3> numbers{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = triangle.corners[k].point;
            const std::uint32_t b = triangle.corners[(k + 1) % 3].point;
            const std::uint32_t low = std::min(a, b);
            const std::uint32_t high = std::max(a, b);
            const auto [number, is_new] = table.number_of(low, high);
            if (is_new) {
                const glm::dvec3 along = world_points_[high] - world_points_[low];
                edges.points.push_back({low, high});
                edges.squared_length.push_back(glm::dot(along, along));
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
int EdgeRefinement::longest_edge(const Edges& edges, std::size_t triangle) const {
    const std::array<std::uint32_t, 3>& e = edges.of_triangle[triangle];
    int longest = 0;
    for (int k = 1; k < 3; ++k) {
        const std::uint32_t candidate = e[static_cast<std::size_t>(k)];
        const std::uint32_t best = e[static_cast<std::size_t>(longest)];
        const double difference = edges.squared_length[candidate] - edges.squared_length[best];
        if (difference > 0.0 || (difference == 0.0 && candidate < best)) {
            longest = k;
        }
    }
    return longest;
}

/// Marks with any edge of a triangle also its longest one.
void EdgeRefinement::mark_longest(const Edges& edges, std::vector<bool>& marked) const {
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
                edges
                    .of_triangle[triangle][static_cast<std::size_t>(longest_edge(edges, triangle))];
            if (!marked[longest]) {
                marked[longest] = true;
                pending.push_back(longest);
            }
        }
    }
}

std::size_t EdgeRefinement::patches_after(const Edges& edges,
                                          const std::vector<bool>& marked) const {
    std::size_t count = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        std::size_t pieces = 1;
        for (const std::uint32_t edge : edges.of_triangle[t]) {
            pieces += marked[edge] ? 1 : 0;
        }
        count += triangles_[t].two_sided ? 2 * pieces : pieces;
    }
    return count;
}

void EdgeRefinement::add_midpoints(const std::vector<bool>& marked, Edges& edges) {
    for (std::size_t e = 0; e < marked.size(); ++e) {
        if (!marked[e]) {
            continue;
        }
        const auto [a, b] = edges.points[e];
        edges.midpoint[e] = add_point(point_object_[a], 0.5F * (points_[a] + points_[b]));
    }
}

std::uint32_t EdgeRefinement::add_point(std::uint32_t object, const glm::vec3& position) {
    const auto number = static_cast<std::uint32_t>(points_.size());
    points_.push_back(position);
    point_object_.push_back(object);
    world_points_.emplace_back(world_from_object_[object] * glm::dvec4(glm::dvec3(position), 1.0));
    return number;
}

std::array<EdgeRefinement::RefinedTriangle, 2> EdgeRefinement::split(
    const RefinedTriangle& triangle, std::size_t edge, std::uint32_t midpoint) {
    const Corner& p = triangle.corners[edge];
    const Corner& q = triangle.corners[(edge + 1) % 3];
    const Corner& r = triangle.corners[(edge + 2) % 3];
    const Corner m = midway(p, q, midpoint);
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
void EdgeRefinement::split_triangles(const Edges& edges) {
    constexpr std::array<std::size_t, 2> outer_edge = {2, 1};  // of the two halves
    std::vector<RefinedTriangle> refined;
    refined.reserve(patch_count_);
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
        const auto longest = static_cast<std::size_t>(longest_edge(edges, t));
        const auto midpoint = [&](std::size_t k) {
            return edges.midpoint[edges.of_triangle[t][(longest + k) % 3]];
        };
        if (midpoint(0) == no_point) {
            refined.push_back(triangles_[t]);
            continue;
        }
        const auto halves = split(triangles_[t], longest, midpoint(0));
        for (std::size_t h = 0; h < halves.size(); ++h) {
            const std::uint32_t outer = midpoint(outer_edge[h]);
            if (outer == no_point) {
                refined.push_back(halves[h]);
                continue;
            }
            for (const RefinedTriangle& quarter : split(halves[h], outer_edge[h], outer)) {
                refined.push_back(quarter);
            }
        }
    }
    triangles_ = std::move(refined);
}

}  // namespace raybundle
