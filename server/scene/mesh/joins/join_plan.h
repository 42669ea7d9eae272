// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "scene/mesh/edge_refinement.h"
#include "scene/scene.h"

namespace raybundle {

/// Longest-edge bisection leaves edges between about half the target and the target; measured on
/// boxes, the mean patch area is this many squared target edges.
constexpr double mean_area = 0.18;

/// Which triangles of a scene are smaller than a patch of some target edge, and how many patches
/// there will be.
class JoinPlan {
  public:
    explicit JoinPlan(const Scene& scene);
    /// Area of all sides, m².
    [[nodiscard]] double total_area() const { return total_; }
    /// Whether some triangle of the scene is smaller than a patch of the target edge (m).
    [[nodiscard]] bool any_small(double edge) const;
    /// Marks those of the unrefined triangles that are, or are part of, such a triangle.
    void mark_small(EdgeRefinement& refinement, double edge) const;
    /// Patches of refined triangles, where those marked are joined to about the size of a patch.
    [[nodiscard]] static std::size_t patches(const EdgeRefinement& refinement, double edge);

  private:
    std::vector<double> area_;  // of the scene's triangles, one side, m²
    double total_ = 0.0;
};

}  // namespace raybundle
