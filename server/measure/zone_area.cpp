// SPDX-License-Identifier: Apache-2.0
#include "measure/zone_area.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace raybundle {
namespace {

glm::dvec2 level(const glm::dvec3& point) {
    return {point.x, point.z};
}

double twice_area(const std::vector<glm::dvec3>& outline) {
    double sum = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = level(outline[i]) - level(outline[0]);
        const glm::dvec2 b = level(outline[(i + 1) % outline.size()]) - level(outline[0]);
        sum += a.x * b.y - a.y * b.x;
    }
    return std::abs(sum);
}

/// Above 0 where c lies on the left of the way from a to b, seen with x to the right and z up; 0 on
/// it, but for rounding.
double side_of(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    constexpr double rounding = 1e-9;  // of the edge's length: of a metre, a nanometre
    const glm::dvec2 edge = b - a;
    const glm::dvec2 to = c - a;
    const double twice = edge.x * to.y - edge.y * to.x;
    return std::abs(twice) <= rounding * glm::dot(edge, edge) ? 0.0 : twice;
}

/// Whether two edges of a polygon cross, or the way through the first corner of the second crosses
/// the first one there. Edges that touch do not: an outline may come back to a corner.
bool crosses(const std::vector<glm::dvec3>& outline, std::size_t first, std::size_t second) {
    const std::size_t count = outline.size();
    const auto corner = [&](std::size_t i) { return level(outline[i % count]); };
    const auto across = [&](std::size_t edge, std::size_t other) {
        const double before = side_of(corner(edge), corner(edge + 1), corner(other));
        const double after = side_of(corner(edge), corner(edge + 1), corner(other + 1));
        return before * after < 0.0;
    };
    if (across(first, second) && across(second, first)) {
        return true;
    }
    const auto passes_at_corner = [&](std::size_t edge, std::size_t at) {
        const glm::dvec2 a = corner(edge);
        const glm::dvec2 b = corner(edge + 1);
        const glm::dvec2 p = corner(at);
        const double along = glm::dot(p - a, b - a) / std::max(glm::dot(b - a, b - a), 1e-300);
        return side_of(a, b, p) == 0.0 && along > 1e-9 && along < 1.0 - 1e-9 &&
               side_of(a, b, corner(at + count - 1)) * side_of(a, b, corner(at + 1)) < 0.0;
    };
    return passes_at_corner(first, second) || passes_at_corner(second, first);
}

double distance_to_edge(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 edge = b - a;
    const double square = glm::dot(edge, edge);
    const double along = square > 0.0 ? std::clamp(glm::dot(p - a, edge) / square, 0.0, 1.0) : 0.0;
    return glm::length(p - a - along * edge);
}

/// Whether a point belongs to what is measured.
bool belongs(const ZoneShape& shape, const glm::dvec2& p) {
    constexpr double rounding = 1e-9;
    bool within = false;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < shape.outline.size(); ++i) {
        const glm::dvec2 a = level(shape.outline[i]);
        const glm::dvec2 b = level(shape.outline[(i + 1) % shape.outline.size()]);
        nearest = std::min(nearest, distance_to_edge(p, a, b));
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
            within = !within;
        }
    }
    return shape.surrounding > 0.0 ? !within && nearest <= shape.surrounding + rounding
                                   : within && nearest >= shape.margin - rounding;
}

/// The rectangle around the polygon, one side along its longest edge, wider by `by` on all sides.
MeasuredArea rectangle_around(const std::vector<glm::dvec3>& outline, double by) {
    glm::dvec2 along(1.0, 0.0);
    double longest = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 edge = level(outline[(i + 1) % outline.size()]) - level(outline[i]);
        if (glm::length(edge) > longest * (1.0 + 1e-9)) {
            longest = glm::length(edge);
            along = edge / longest;
        }
    }
    const glm::dvec2 across(-along.y, along.x);
    glm::dvec2 low(std::numeric_limits<double>::max());
    glm::dvec2 high(std::numeric_limits<double>::lowest());
    for (const glm::dvec3& corner : outline) {
        const glm::dvec2 at(glm::dot(level(corner), along), glm::dot(level(corner), across));
        low = glm::min(low, at - by);
        high = glm::max(high, at + by);
    }
    const glm::dvec2 origin = low.x * along + low.y * across;
    const glm::dvec2 u = (high.x - low.x) * along;
    const glm::dvec2 v = (high.y - low.y) * across;
    return {{origin.x, outline[0].y, origin.y}, {u.x, 0.0, u.y}, {v.x, 0.0, v.y}};
}

std::uint32_t steps_along(double side, double spacing) {
    const double count = std::ceil(side / spacing * (1.0 - 1e-9));
    return static_cast<std::uint32_t>(std::clamp(count, 1.0, 1e6));
}

}  // namespace

std::string outline_problem(const std::vector<glm::dvec3>& outline) {
    constexpr double least = 1e-6;  // m²
    if (outline.size() < 3) {
        return "needs three corners or more";
    }
    const std::size_t count = outline.size();
    const auto edge = [count](std::size_t i) {
        return fmt::format("from corner {} to {}", i + 1, (i + 1) % count + 1);
    };
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = i + 1; k < count; ++k) {
            if (crosses(outline, i, k)) {
                return fmt::format("crosses itself: the edge {} meets that {}", edge(i), edge(k));
            }
        }
    }
    return twice_area(outline) > 2.0 * least ? "" : "has no area: its corners lie on a line";
}

ZoneGrid lay_grid(const ZoneShape& shape, const GridSize& wanted, std::uint64_t most) {
    ZoneGrid result;
    const bool strip = shape.surrounding > 0.0;
    result.area = rectangle_around(shape.outline, strip ? shape.surrounding : -shape.margin);
    const double length = glm::length(result.area.u);
    const double width = glm::length(result.area.v);
    result.grid = wanted;
    if (wanted.points() == 0) {
        result.spacing = en12464_spacing(length, width);
        const double spacing = strip ? std::min(result.spacing, shape.surrounding) : result.spacing;
        result.grid = {steps_along(length, spacing), steps_along(width, spacing)};
    }
    constexpr std::uint64_t most_cells = 1U << 20U;
    if (result.grid.points() > most_cells) {
        return result;
    }
    const std::vector<glm::dvec3> all = points_of(result.area, result.grid);
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (belongs(shape, level(all[i]))) {
            result.cells.push_back(static_cast<std::uint32_t>(i));
            result.points.push_back(all[i]);
        }
    }
    if (result.points.size() > most) {
        result.points.clear();
    }
    return result;
}

std::vector<glm::dvec3> outline_of(const MeasuredArea& area) {
    return {area.origin, area.origin + area.u, area.origin + area.u + area.v, area.origin + area.v};
}

}  // namespace raybundle
