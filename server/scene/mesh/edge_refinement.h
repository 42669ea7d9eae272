// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/contact/contact_lines.h"
#include "scene/scene.h"

namespace raybundle {

/// Longest-edge bisection of a scene's triangles (Rivara, "Algorithms for refining triangular grids
/// suitable for adaptive and multigrid techniques", 1984). Neighbours are found through welded
/// positions inside each object, whatever their normals and uv, and an edge is always split on both
/// sides at the same point, so that no T-junction arises. Deterministic.
class EdgeRefinement {
  public:
    static constexpr std::uint32_t no_point = 0xffffffffU;
    static constexpr std::uint32_t no_edge = 0xffffffffU;

    struct Corner {
        std::uint32_t point = 0;  ///< index into points()
        glm::vec3 normal{0.0F};   ///< object space, unit
        glm::vec2 uv{0.0F};
        glm::vec3 colour{1.0F};
    };
    struct RefinedTriangle {
        std::array<Corner, 3> corners;
        std::uint32_t material = 0;
        std::uint32_t object = 0;
        bool two_sided = false;  ///< both of its sides are patches
        bool small = false;      ///< it is, or is part of, a triangle that will be joined to others
        std::uint32_t node = 0;  ///< its leaf in nodes()
    };
    /// A triangle on the way from the unrefined to the refined ones. Corners p, q, r with an edge
    /// pq that is split at m leave the children (p, m, r) and (m, q, r).
    struct Node {
        static constexpr std::uint32_t no_children = 0xffffffffU;
        std::uint8_t split_edge = 0;              ///< k: from corner k to corner k + 1
        std::uint32_t first_child = no_children;  ///< the second one follows it
    };

    explicit EdgeRefinement(const Scene& scene);

    /// Cuts triangles along lines, sorted by triangle, and with them their neighbours where the
    /// edges in common are split. Corners within `resolution` (m) of a line count as on it. What
    /// comes out is what is unrefined. Before refine(), once.
    void cut(std::span<const ContactLine> lines, double resolution);

    /// Tells which of the unrefined triangles will be joined to others. Before refine().
    void mark_small(const std::vector<bool>& small);

    /// Splits until no edge is longer than `target_edge` (m, world space), or than twice that where
    /// all triangles at it are small. False, with the work half done, as soon as there would be
    /// more than `max_patches`.
    bool refine(double target_edge, std::size_t max_patches);

    /// Splits the longest edges of some triangles (by index), and of neighbours as it takes. Those
    /// chosen are small no more. False, with nothing done, if there would be more than
    /// `max_patches`.
    bool split(const std::vector<bool>& chosen, std::size_t max_patches);

    /// World space, m, counter-clockwise from the front.
    [[nodiscard]] std::array<glm::dvec3, 3> world_corners(const RefinedTriangle& triangle) const;
    [[nodiscard]] const std::vector<RefinedTriangle>& triangles() const { return triangles_; }
    [[nodiscard]] const std::vector<glm::vec3>& points() const { return points_; }
    /// The scene's triangles, cut, as they were before refine(); triangle i has node i.
    [[nodiscard]] const std::vector<RefinedTriangle>& unrefined() const { return unrefined_; }
    /// Of each of them the triangle of the scene that it is, or is cut from.
    [[nodiscard]] const std::vector<std::uint32_t>& origins() const { return origins_; }
    /// All triangles there ever were since; the unrefined come first, in their order.
    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
    /// Front sides, and back sides of two-sided triangles.
    [[nodiscard]] std::size_t patch_count() const { return patch_count_; }

  private:
    /// The edges of the present triangles.
    struct Edges {
        std::vector<std::array<std::uint32_t, 3>> of_triangle;  // edge k joins corners k and k+1
        std::vector<std::array<std::uint32_t, 2>> points;       // smaller number first
        std::vector<double> squared_length;                     // m², world
        std::vector<std::uint32_t> midpoint;                    // no_point where not split
    };

    void begin_refinement();
    /// Splits of edges at contact lines: parts of the way from an edge's first point, by number.
    using Parts = std::vector<float>;
    bool mark_crossings(std::size_t triangle, const ContactLine& line, double resolution,
                        Edges& edges, Parts& parts);
    void add_divided(const RefinedTriangle& triangle, const std::array<std::uint32_t, 3>& numbers,
                     const Edges& edges, const Parts& parts,
                     std::vector<RefinedTriangle>& result) const;
    std::uint32_t add_point(std::uint32_t object, const glm::vec3& position);
    [[nodiscard]] Edges find_edges() const;
    [[nodiscard]] int longest_edge(const Edges& edges, std::size_t triangle) const;
    void mark_longest(const Edges& edges, std::vector<bool>& marked) const;
    [[nodiscard]] std::size_t patches_after(const Edges& edges,
                                            const std::vector<bool>& marked) const;
    void add_midpoints(const std::vector<bool>& marked, Edges& edges);
    void split_triangles(const Edges& edges);
    std::array<RefinedTriangle, 2> split(const RefinedTriangle& triangle, std::size_t edge,
                                         std::uint32_t midpoint);

    std::vector<RefinedTriangle> triangles_, unrefined_;
    std::vector<std::uint32_t> origins_;
    std::vector<Node> nodes_;
    std::vector<glm::vec3> points_;  // object space
    std::vector<glm::dvec3> world_points_;
    std::vector<std::uint32_t> point_object_;
    std::vector<glm::dmat4> world_from_object_;
    std::size_t patch_count_ = 0;
};

}  // namespace raybundle
