// SPDX-License-Identifier: Apache-2.0
#include "scene/photometry/luminaire_body.h"

#include <algorithm>
#include <cmath>

#include "scene/light/punctual_light.h"

namespace raybundle {
namespace {

/// Depth of the housing over the shorter side of the opening, and at most, m. For the eye alone:
/// files of a common kind do not state it.
constexpr double housing_share = 0.1;
constexpr double most_housing = 0.05;

/// Where a line is within a body, by its distance from some point of the line.
struct Way {
    double in = 0.0, out = 0.0;
    bool by_side = false;  ///< it enters neither at the bottom nor at the top
    bool by_x = false;     ///< of a box: at a side that faces along x
};

std::optional<Way> way_through(const LuminaireBody& body, const glm::dvec3& o,
                               const glm::dvec3& d) {
    const glm::dvec2 plates = (glm::dvec2(body.low, body.high) - o.z) / d.z;
    double side_in = 0.0;
    double side_out = 0.0;
    Way way;
    if (body.profile->data().opening.round) {
        const glm::dvec2 p = glm::dvec2(o) / body.half;
        const glm::dvec2 q = glm::dvec2(d) / body.half;
        const double a = glm::dot(q, q);
        const double b = glm::dot(p, q);
        const double square = b * b - a * (glm::dot(p, p) - 1.0);
        if (square < 0.0) {
            return std::nullopt;
        }
        side_in = (-b - std::sqrt(square)) / a;
        side_out = (-b + std::sqrt(square)) / a;
    } else {
        const glm::dvec2 first = (-body.half - glm::dvec2(o)) / glm::dvec2(d);
        const glm::dvec2 second = (body.half - glm::dvec2(o)) / glm::dvec2(d);
        const glm::dvec2 in = glm::min(first, second);
        const glm::dvec2 out = glm::max(first, second);
        side_in = std::max(in.x, in.y);
        side_out = std::min(out.x, out.y);
        way.by_x = in.x > in.y;
    }
    const double plate_in = std::min(plates.x, plates.y);
    way.in = std::max(side_in, plate_in);
    way.out = std::min(side_out, std::max(plates.x, plates.y));
    way.by_side = side_in > plate_in;
    return way.in < way.out ? std::optional(way) : std::nullopt;
}

/// Of what shines on the side where a line enters, m. towards: unit, to the eye.
double luminous_height(const IesProfile::Opening& opening, const Way& way,
                       const glm::dvec3& towards) {
    const double on_x = opening.heights[towards.x > 0.0 ? 0 : 2];
    const double on_y = opening.heights[towards.y > 0.0 ? 1 : 3];
    if (!opening.round) {
        return way.by_x ? on_x : on_y;
    }
    const double x = towards.x * towards.x;  // as in projected_area()
    const double y = towards.y * towards.y;
    return (x * on_x + y * on_y) / (x + y);
}

}  // namespace

double LuminaireBody::radius() const {
    return std::sqrt(glm::dot(half, half) + std::max(low * low, high * high));
}

double LuminaireBody::tolerance(double distance) const {
    return 1e-3 * radius() + 1e-5 * distance;
}

std::optional<LuminaireBody> body_of(const PlacedLight& light) {
    if (!light.profile) {
        return std::nullopt;
    }
    const IesProfile::Opening& opening = light.profile->data().opening;
    if (!(opening.length > 0.0 && opening.width > 0.0)) {
        return std::nullopt;
    }
    LuminaireBody body;
    body.position = light.position;
    body.axes = light.axes;
    body.half = 0.5 * glm::dvec2(opening.length, opening.width);
    const double height = *std::max_element(opening.heights.begin(), opening.heights.end());
    body.low = -0.5 * height;
    body.high = 0.5 * height +
                std::min(housing_share * std::min(opening.length, opening.width), most_housing);
    body.intensity = light.intensity;
    body.profile = light.profile;
    return body;
}

std::optional<LuminaireHit> meet(const LuminaireBody& body, const glm::dvec3& origin,
                                 const glm::dvec3& direction) {
    const glm::dvec3 from = origin - body.position;
    const double nearest = -glm::dot(from, direction);
    const glm::dvec3 beside = from + nearest * direction;  // the ray's point next to the position
    const double radius = body.radius();
    if (glm::dot(beside, beside) > radius * radius || nearest < -radius) {
        return std::nullopt;
    }
    constexpr double parallel = 1e-9;
    glm::dvec3 d = direction * body.axes;
    for (int k = 0; k < 3; ++k) {
        d[k] = std::abs(d[k]) < parallel ? parallel : d[k];
    }
    const glm::dvec3 o = beside * body.axes;
    const std::optional<Way> way = way_through(body, o, d);
    if (!way || !(nearest + way->in > 0.0)) {
        return std::nullopt;
    }
    LuminaireHit hit{nearest + way->in, glm::dvec3(0.0)};
    const IesProfile::Opening& opening = body.profile->data().opening;
    const double above = o.z + way->in * d.z - body.low;
    if (!way->by_side || above < luminous_height(opening, *way, -d)) {
        const double candela = body.profile->candela(-d);
        const double area = opening.projected_area(-d);
        hit.luminance = area > 0.0 ? body.intensity * (candela / area) : glm::dvec3(0.0);
    }
    return hit;
}

}  // namespace raybundle
