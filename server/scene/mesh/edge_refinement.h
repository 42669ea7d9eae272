// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <vector>

#include "scene/contact/contact_lines.h"
#include "scene/mesh/bisection_node.h"
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

    using Node = BisectionNode;

    /// What a surface has at a corner besides its place.
    struct Shading {
        glm::vec3 normal{0.0F};  ///< object space, unit
        glm::vec2 uv{0.0F};
        glm::vec3 colour{1.0F};

        bool operator==(const Shading&) const = default;
    };
    struct Corner {
        std::uint32_t point = 0;    ///< index into points()
        std::uint32_t shading = 0;  ///< what shading() takes
    };
    struct RefinedTriangle {
        std::array<Corner, 3> corners;
        std::uint32_t material = 0;
        std::uint32_t object = 0;
        std::uint32_t node = 0;  ///< its leaf in nodes()
        bool two_sided = false;  ///< both of its sides are patches
        bool small = false;      ///< it is, or is part of, a triangle that will be joined to others
    };

    /// The scene must outlive it.
    explicit EdgeRefinement(const Scene& scene);

    /// Cuts triangles along lines, sorted by triangle, and with them their neighbours where the
    /// edges in common are split. Corners within `resolution` (m) of a line count as on it. What
    /// comes out is what is unrefined. Before refine(), once.
    void cut(std::span<const ContactLine> lines, double resolution);

    /// Goes back to the unrefined triangles, none of them small.
    void restart();

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
    [[nodiscard]] Shading shading(std::uint32_t number) const;
    /// The scene's triangles, cut, as they were before refine(); triangle i has node i.
    [[nodiscard]] const std::vector<RefinedTriangle>& unrefined() const {
        return unrefined_->triangles;
    }
    /// Of each of them the triangle of the scene that it is, or is cut from.
    [[nodiscard]] const std::vector<std::uint32_t>& origins() const { return unrefined_->origins; }
    /// All triangles there ever were since; the unrefined come first, in their order.
    [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
    /// Front sides, and back sides of two-sided triangles.
    [[nodiscard]] std::size_t patch_count() const { return patch_count_; }
    /// Frees the memory of triangles(), which are no longer there then.
    void drop_triangles() { triangles_ = {}; }

  private:
    /// Where refinement begins. Copies share it.
    struct Unrefined {
        std::vector<RefinedTriangle> triangles;
        std::vector<std::uint32_t> origins;
        std::size_t points = 0, shadings = 0, patches = 0;
    };
    /// Triangles that are worked on: whatever has points in common with one of them is there, too.
    struct Work {
        std::vector<RefinedTriangle> triangles;
        std::vector<std::uint32_t> places;  // in triangles_, of which they are pieces
    };
    /// The edges of such triangles.
    struct Edges {
        std::vector<std::array<std::uint32_t, 3>> of_triangle;  // edge k joins corners k and k+1
        std::vector<std::array<std::uint32_t, 2>> points;       // smaller number first
        std::vector<double> squared_length;                     // m², world
        std::vector<std::uint32_t> midpoint;                    // no_point where not split
    };

    void join_points();
    void begin_refinement();
    /// The triangles of some components of the mesh, and their pieces back into triangles_.
    [[nodiscard]] Work take(const std::vector<bool>& components) const;
    void put_back(Work work);
    [[nodiscard]] std::uint32_t component_of(const RefinedTriangle& triangle) const {
        return point_component_[triangle.corners[0].point];
    }
    [[nodiscard]] Work longer_than(double target_edge) const;
    /// Splits of edges at contact lines: parts of the way from an edge's first point, by number.
    using Parts = std::vector<float>;
    bool mark_crossings(const std::array<std::uint32_t, 3>& numbers, const ContactLine& line,
                        double resolution, Edges& edges, Parts& parts);
    void add_divided(const RefinedTriangle& triangle, const std::array<std::uint32_t, 3>& numbers,
                     const Edges& edges, const Parts& parts, std::vector<RefinedTriangle>& result);
    std::uint32_t add_point(std::uint32_t component, const glm::vec3& position);
    std::uint32_t add_shading(const Shading& shading);
    [[nodiscard]] glm::dvec3 world_point(std::uint32_t point) const;
    [[nodiscard]] double squared_length(std::uint32_t low, std::uint32_t high) const;
    [[nodiscard]] Edges find_edges(const std::vector<RefinedTriangle>& triangles) const;
    static std::size_t longest_edge(const Edges& edges, std::size_t triangle);
    static void mark_longest(const Edges& edges, std::vector<bool>& marked);
    void add_midpoints(const std::vector<bool>& marked, Edges& edges);
    void split_triangles(const Edges& edges, Work& work);
    std::array<RefinedTriangle, 2> split(const RefinedTriangle& triangle, std::size_t edge,
                                         std::uint32_t midpoint);

    const Scene* scene_;
    std::shared_ptr<const Unrefined> unrefined_;
    std::vector<RefinedTriangle> triangles_;
    std::vector<Node> nodes_;
    std::vector<Shading> shadings_;  // those after the scene's vertices
    std::vector<glm::vec3> points_;  // object space
    // Least number of those points that are joined to it by edges.
    std::vector<std::uint32_t> point_component_;
    std::vector<std::uint32_t> component_object_;  // by point
    std::vector<glm::dmat4> world_from_object_;
    std::size_t patch_count_ = 0;
};

}  // namespace raybundle
