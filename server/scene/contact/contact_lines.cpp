// SPDX-License-Identifier: Apache-2.0
#include "scene/contact/contact_lines.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "scene/contact/box_tree.h"
#include "scene/contact/world_triangle.h"

namespace raybundle {
namespace {

// Lengths are shares of a patch's edge.
constexpr double touching = 0.05;
constexpr double shortest_line = 0.5;
constexpr double least_coverage = 0.5;      // of the line's way across the triangle
constexpr double parallel_cosine = 0.9;     // surfaces less inclined than that lie on one another
constexpr std::size_t max_candidates = 32;  // lines that are told apart on one triangle

using Corners = std::array<glm::dvec3, 3>;
using Interval = std::pair<double, double>;  // m along a line

struct Segment {
    glm::dvec3 from{0.0}, to{0.0};
};

/// A line of segments: all within the resolution of the first one's.
struct Candidate {
    glm::dvec3 start{0.0}, along{0.0};  // along: unit
    std::vector<Interval> covered;
    double length = 0.0;  // m, of their union
};

/// A triangle that is large enough to be cut.
struct Face {
    std::uint32_t triangle = 0;
    Corners corners{};
    glm::dvec3 normal{0.0};
    bool double_sided = false;
    std::vector<Candidate> candidates;
};

double longest_edge(const Corners& c) {
    return std::max(
        {glm::distance(c[0], c[1]), glm::distance(c[1], c[2]), glm::distance(c[2], c[0])});
}

BoxTree::Box box_of(const Corners& c, double margin) {
    return {glm::min(c[0], glm::min(c[1], c[2])) - margin,
            glm::max(c[0], glm::max(c[1], c[2])) + margin};
}

/// Where a triangle goes through the plane dot(normal, x) = offset.
std::optional<Segment> cross_section(const Corners& corners, const glm::dvec3& normal,
                                     double offset) {
    std::array<double, 3> height{};
    for (std::size_t k = 0; k < 3; ++k) {
        height[k] = glm::dot(normal, corners[k]) - offset;
    }
    std::array<glm::dvec3, 2> ends{};
    std::size_t found = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        if ((height[k] < 0.0) != (height[next] < 0.0)) {
            const double t = height[k] / (height[k] - height[next]);
            ends[found++] = glm::mix(corners[k], corners[next], t);
        }
    }
    return found == 2 ? std::optional(Segment{ends[0], ends[1]}) : std::nullopt;
}

/// The part of the line start + t * along, t within an interval, that lies over a triangle.
std::optional<Interval> clipped(const Face& face, const glm::dvec3& start, const glm::dvec3& along,
                                Interval t) {
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 inward =
            glm::cross(face.normal, face.corners[(k + 1) % 3] - face.corners[k]);
        const double at_start = glm::dot(inward, start - face.corners[k]);
        const double slope = glm::dot(inward, along);
        if (slope == 0.0) {
            if (at_start < 0.0) {
                return std::nullopt;
            }
            continue;
        }
        const double crossing = -at_start / slope;
        (slope > 0.0 ? t.first : t.second) =
            slope > 0.0 ? std::max(t.first, crossing) : std::min(t.second, crossing);
    }
    return t.first < t.second ? std::optional(t) : std::nullopt;
}

double length_of_union(std::vector<Interval>& intervals) {
    std::sort(intervals.begin(), intervals.end());
    double length = 0.0;
    double end = -1e300;
    for (const auto& [from, to] : intervals) {
        length += std::max(0.0, to - std::max(from, end));
        end = std::max(end, to);
    }
    return length;
}

class ContactSearch {
  public:
    ContactSearch(const Scene& scene, double patch_edge)
        : scene_(scene), patch_edge_(patch_edge), faces_(large_faces()), tree_(boxes()) {}

    std::vector<ContactLine> run() {
        for (std::size_t i = 0; i < scene_.triangles.size(); ++i) {
            add_contacts_of(i);
        }
        std::vector<ContactLine> lines;
        for (Face& face : faces_) {
            add_lines_of(face, lines);
        }
        return lines;
    }

  private:
    [[nodiscard]] std::vector<Face> large_faces() const {
        std::vector<Face> faces;
        for (std::size_t i = 0; i < scene_.triangles.size(); ++i) {
            Face face;
            face.triangle = static_cast<std::uint32_t>(i);
            face.corners = world_corners(scene_, scene_.triangles[i]);
            const glm::dvec3 area = double_area(face.corners);
            if (glm::length(area) > 0.0 &&
                longest_edge(face.corners) >= shortest_line * patch_edge_) {
                face.normal = glm::normalize(area);
                face.double_sided = two_sided(scene_, scene_.triangles[i]);
                faces.push_back(face);
            }
        }
        return faces;
    }

    [[nodiscard]] std::vector<BoxTree::Box> boxes() const {
        std::vector<BoxTree::Box> boxes;
        boxes.reserve(faces_.size());
        for (const Face& face : faces_) {
            boxes.push_back(box_of(face.corners, touching * patch_edge_));
        }
        return boxes;
    }

    /// What a triangle touches.
    void add_contacts_of(std::size_t triangle) {
        const Corners corners = world_corners(scene_, scene_.triangles[triangle]);
        const glm::dvec3 area = double_area(corners);
        if (!(glm::length(area) > 0.0)) {
            return;
        }
        const glm::dvec3 normal = glm::normalize(area);
        tree_.for_each_overlapping(box_of(corners, 0.0), [&](std::uint32_t f) {
            Face& face = faces_[f];
            if (face.triangle == triangle ||
                std::abs(glm::dot(normal, face.normal)) > parallel_cosine) {
                return;
            }
            const double plane = glm::dot(face.normal, face.corners[0]);
            const double gap = touching * patch_edge_;
            if (const auto segment = cross_section(corners, face.normal, plane + gap)) {
                add_segment(face, *segment);
            }
            if (face.double_sided) {
                if (const auto segment = cross_section(corners, face.normal, plane - gap)) {
                    add_segment(face, *segment);
                }
            }
        });
    }

    void add_segment(Face& face, const Segment& segment) const {
        const double length = glm::distance(segment.from, segment.to);
        if (!(length > 0.0)) {
            return;
        }
        const glm::dvec3 along = (segment.to - segment.from) / length;
        const auto part = clipped(face, segment.from, along, {0.0, length});
        if (!part) {
            return;
        }
        const glm::dvec3 from = segment.from + part->first * along;
        const glm::dvec3 to = segment.from + part->second * along;
        for (Candidate& candidate : face.candidates) {
            if (on_line(candidate, from) && on_line(candidate, to)) {
                const double a = glm::dot(from - candidate.start, candidate.along);
                const double b = glm::dot(to - candidate.start, candidate.along);
                candidate.covered.emplace_back(std::min(a, b), std::max(a, b));
                return;
            }
        }
        if (face.candidates.size() < max_candidates) {
            face.candidates.push_back({from, along, {{0.0, part->second - part->first}}, 0.0});
        }
    }

    [[nodiscard]] bool on_line(const Candidate& line, const glm::dvec3& point) const {
        const glm::dvec3 away = point - line.start;
        return glm::length(away - glm::dot(away, line.along) * line.along) <=
               0.5 * contact_resolution * patch_edge_;
    }

    /// Those of a face's candidates that go most of the way across it.
    void add_lines_of(Face& face, std::vector<ContactLine>& lines) const {
        std::vector<Candidate> kept;
        for (Candidate& candidate : face.candidates) {
            candidate.length = length_of_union(candidate.covered);
            const auto across = clipped(face, candidate.start, candidate.along, {-1e300, 1e300});
            if (across) {
                const double way = across->second - across->first;
                if (way >= shortest_line * patch_edge_ &&
                    candidate.length >= least_coverage * way) {
                    kept.push_back(candidate);
                }
            }
        }
        std::stable_sort(kept.begin(), kept.end(), [](const Candidate& a, const Candidate& b) {
            return a.length > b.length;
        });
        kept.resize(std::min(kept.size(), max_contact_lines));
        for (const Candidate& candidate : kept) {
            const glm::dvec3 normal = glm::normalize(glm::cross(face.normal, candidate.along));
            lines.push_back({face.triangle, normal, glm::dot(normal, candidate.start)});
        }
    }

    const Scene& scene_;
    double patch_edge_;
    std::vector<Face> faces_;
    BoxTree tree_;
};

}  // namespace

std::vector<ContactLine> find_contact_lines(const Scene& scene, double patch_edge) {
    return ContactSearch(scene, patch_edge).run();
}

}  // namespace raybundle
