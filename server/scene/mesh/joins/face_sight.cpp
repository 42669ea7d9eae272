// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/joins/face_sight.h"

#include <algorithm>
#include <array>

namespace raybundle {
namespace {

constexpr float past_middle = 1.05F;  // of the way to an edge: so far rays look
constexpr double near_corner = 0.9;   // of the way there from the middle of a face
constexpr double flat_cosine = 0.9;   // faces that are less bent see each other across their edge

glm::dvec3 middle_of(const JoinFace& face) {
    return (face.corners[0] + face.corners[1] + face.corners[2]) / 3.0;
}

glm::dvec3 normal_of(const JoinFace& face) {
    const glm::dvec3 across =
        glm::cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
    const double size = glm::length(across);
    return size > 0.0 ? across / size : glm::dvec3(0.0);
}

bool has_point(const JoinFace& face, std::uint32_t point) {
    return std::find(face.points.begin(), face.points.end(), point) != face.points.end();
}

/// Middle of the edge that two faces have in common.
glm::dvec3 common_edge(const JoinFace& a, const JoinFace& b) {
    glm::dvec3 sum(0.0);
    double count = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        if (has_point(b, a.points[k])) {
            sum += a.corners[k];
            count += 1.0;
        }
    }
    return count > 0.0 ? sum / count : middle_of(a);
}

/// Near the corner of a face that another one, with which it has an edge, has not.
glm::dvec3 far_place(const JoinFace& face, const JoinFace& other) {
    glm::dvec3 corner = face.corners[0];
    for (std::size_t k = 0; k < 3; ++k) {
        corner = has_point(other, face.points[k]) ? corner : face.corners[k];
    }
    return glm::mix(middle_of(face), corner, near_corner);
}

}  // namespace

/// A little above a place on a face, on its front (side 1) or its back (-1).
glm::vec3 FaceSight::above(const JoinFace& face, const glm::dvec3& place, double side) const {
    return {place + side * lift_ * normal_of(face)};
}

/// normals: sum of both faces'. Over an edge that is bent rays go past a place above its middle.
bool FaceSight::over(const glm::vec3& from, const glm::vec3& to, const glm::dvec3& edge,
                     const glm::dvec3& normals, bool flat, double side) const {
    if (flat) {
        return !rays_.blocked(from, to);
    }
    const double length = glm::length(normals);
    const glm::vec3 place(edge + (length > 0.0 ? side * lift_ / length : 0.0) * normals);
    const auto seen = [&](const glm::vec3& start) {
        return !rays_.blocked(start, start + past_middle * (place - start));
    };
    return seen(from) && seen(to);
}

/// From middle to middle, and between what lies farthest from the edge.
bool FaceSight::across(const JoinFace& a, const JoinFace& b, double side) const {
    const glm::dvec3 edge = common_edge(a, b);
    const glm::dvec3 normal_a = normal_of(a);
    const glm::dvec3 normal_b = normal_of(b);
    const bool flat = glm::dot(normal_a, normal_b) >= flat_cosine;
    const auto seen = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return over(above(a, from, side), above(b, to, side), edge, normal_a + normal_b, flat,
                    side);
    };
    return seen(middle_of(a), middle_of(b)) && seen(far_place(a, b), far_place(b, a));
}

bool FaceSight::across(std::uint32_t a, std::uint32_t b) const {
    const JoinFace face_a = faces_.at(a);
    const JoinFace face_b = faces_.at(b);
    return across(face_a, face_b, 1.0) && (!face_a.two_sided || across(face_a, face_b, -1.0));
}

/// From near all corners of a face.
bool FaceSight::middle_seen(const JoinFace& face, const JoinFace& from, double side) const {
    const glm::vec3 to = above(face, middle_of(face), side);
    return std::all_of(from.corners.begin(), from.corners.end(), [&](const glm::dvec3& corner) {
        return !rays_.blocked(above(from, glm::mix(middle_of(from), corner, near_corner), side),
                              to);
    });
}

bool FaceSight::between(std::uint32_t a, std::uint32_t b) const {
    const JoinFace face_a = faces_.at(a);
    const JoinFace face_b = faces_.at(b);
    const auto seen = [&](double side) {
        return middle_seen(face_a, face_b, side) && middle_seen(face_b, face_a, side);
    };
    return seen(1.0) && (!face_a.two_sided || seen(-1.0));
}

}  // namespace raybundle
