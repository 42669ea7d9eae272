// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>

#include "scene/mesh/patch_mesh.h"
#include "trace/gloss_ray.h"
#include "trace/lamp_rays.h"
#include "trace/line_order.h"
#include "trace/ray_grid.h"

namespace raybundle {

/// Builds bundles and pictures by rays, where OpenGL runs on the processor: the same surfaces that
/// the rasteriser finds, at a cost that hardly grows with their number. Surfaces are 2 * facet +
/// side. Works on all cores; results do not depend on their number.
class FacetTracer {
  public:
    /// world_from_object: of each object, the world being the one of the rays. Throws
    /// std::runtime_error where there is no memory for the tree.
    FacetTracer(const Scene& scene, const PatchMesh& mesh,
                std::span<const glm::mat4> world_from_object);
    ~FacetTracer();

    void update_material(const Scene& scene, std::size_t material);
    /// Moves a movable object, and keeps its present place as the one before until settle().
    /// Throws std::invalid_argument for one that is not movable.
    void move(std::uint32_t object, const glm::mat4& world_from_object);
    void settle();

    /// Receives first hits, at the pixel's place of RayGrid::result.
    struct Nearest {
        std::uint32_t* surfaces = nullptr;  ///< no_hit where there is none
        float* depths =
            nullptr;  ///< where they are wanted: depth_scale / way, 0 where there is none
        float depth_scale = 0.0F;
    };
    static constexpr std::uint32_t no_hit = 0xffffffffU;
    /// First hits. hidden: objects that rays do not meet.
    void nearest(std::span<const RayGrid> grids, const TraceRules& rules, const Nearest& result,
                 std::span<const std::uint32_t> hidden = {});

    /// Receives all hits of the lines, in the layout of shaders/bundle/layers.glsl.
    struct Lists {
        std::uint32_t* counts = nullptr;
        std::uint32_t* surfaces = nullptr;
        std::size_t pixels = 0;      ///< of the window
        std::uint32_t capacity = 0;  ///< surfaces of a line, at most
    };
    /// All surfaces that lines meet, in order. Returns the length of the longest list; lists are
    /// cut off at the capacity.
    std::uint32_t all(const RayGrid& grid, const TraceRules& rules, const LineOrder& order,
                      const Lists& result);
    /// Which of the lamps that a point is asked for reach it, bit by slot. Alpha cuts holes, and
    /// what `rules` say of glass holds.
    void reach(std::span<const LampPoint> points, const LampQuestion& question,
               std::span<std::uint32_t> lit);
    /// Follows the rays that are in use to the first surface. tie: m, what is no higher above a
    /// ray's origin belongs to its surface.
    void follow(std::span<GlossRay> rays, const TraceRules& rules, float tie);
    [[nodiscard]] std::size_t bytes() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace raybundle
