// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/joins/join_plan.h"

#include <algorithm>

namespace raybundle {
namespace {

double area_of(const EdgeRefinement& refinement, const EdgeRefinement::RefinedTriangle& triangle) {
    const auto corners = refinement.world_corners(triangle);
    return 0.5 * glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
}

}  // namespace

JoinPlan::JoinPlan(const Scene& scene) {
    std::vector<glm::dmat4> world;
    for (const Object& object : scene.objects) {
        world.emplace_back(object.world_from_object());
    }
    area_.reserve(scene.triangles.size());
    for (const Triangle& triangle : scene.triangles) {
        glm::dvec3 p[3];
        for (int k = 0; k < 3; ++k) {
            p[k] = world[triangle.object] *
                   glm::dvec4(glm::dvec3(scene.vertices[triangle.vertex[k]].position), 1.0);
        }
        area_.push_back(0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0])));
        total_ += (two_sided(scene, triangle) ? 2.0 : 1.0) * area_.back();
    }
}

bool JoinPlan::any_small(double edge) const {
    return std::any_of(area_.begin(), area_.end(),
                       [&](double area) { return area < mean_area * edge * edge; });
}

void JoinPlan::mark_small(EdgeRefinement& refinement, double edge) const {
    std::vector<bool> small;
    small.reserve(refinement.origins().size());
    for (const std::uint32_t origin : refinement.origins()) {
        small.push_back(area_[origin] < mean_area * edge * edge);
    }
    refinement.mark_small(small);
}

std::size_t JoinPlan::patches(const EdgeRefinement& refinement, double edge) {
    constexpr double filled = 0.6;  // of a patch's area, by a set in the mean
    double joined = 0.0;
    std::size_t count = 0;
    for (const EdgeRefinement::RefinedTriangle& triangle : refinement.triangles()) {
        const std::size_t sides = triangle.two_sided ? 2 : 1;
        if (triangle.small) {
            joined += static_cast<double>(sides) * area_of(refinement, triangle);
        } else {
            count += sides;
        }
    }
    return count + static_cast<std::size_t>(joined / (filled * mean_area * edge * edge));
}

}  // namespace raybundle
