// SPDX-License-Identifier: Apache-2.0
#include "scene/object_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/neighbourhood.h"

namespace raybundle {
namespace {

constexpr double half_unit_in_last_place = 0x1.0p-24;  // of single precision
constexpr double centimetre = 0.01;

double largest(const glm::dvec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Distance from zero of the farthest corner along any axis, m; of an empty box, of its zero.
double reach(const Bounds& box, const glm::dmat4& matrix) {
    if (box.empty()) {
        return largest(glm::dvec3(matrix[3]));
    }
    double farthest = 0.0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec3 point((corner & 1U) != 0 ? box.max.x : box.min.x,
                               (corner & 2U) != 0 ? box.max.y : box.min.y,
                               (corner & 4U) != 0 ? box.max.z : box.min.z);
        farthest = std::max(farthest, largest(glm::dvec3(matrix * glm::dvec4(point, 1.0))));
    }
    return farthest;
}

}  // namespace

double farthest_place(const Scene& scene) {
    const double tie = coincidence_share * double{glm::length(scene.bounds.extent())};
    return std::max(centimetre, tie) / half_unit_in_last_place;
}

std::string problem_of(const Scene& scene, std::size_t object, const Transform& transform) {
    const Object& moved = scene.objects[object];
    const double limit = farthest_place(scene);
    const glm::dmat4 place = glm::dmat4(moved.world_from_parent) * glm::dmat4(transform.matrix());
    const glm::dvec3 middle(moved.bounds.empty() ? glm::vec3(0.0F) : moved.bounds.centre());
    const double centre = largest(glm::dvec3(place * glm::dvec4(middle, 1.0)));
    if (!(centre <= limit)) {
        return fmt::format(
            "translation: puts object {} {:.3g} m away from zero; the limit is {:.0f} m", moved.id,
            centre, limit);
    }
    const double farthest = reach(moved.bounds, place);
    if (!(farthest <= limit)) {
        return fmt::format(
            "scale: lets object {} reach {:.3g} m away from zero; the limit is {:.0f} m", moved.id,
            farthest, limit);
    }
    return {};
}

}  // namespace raybundle
