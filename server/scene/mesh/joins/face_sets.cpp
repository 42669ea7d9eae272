// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh/joins/face_sets.h"

#include <numeric>

namespace raybundle {
namespace {

FaceSet set_of(const JoinFace& face, std::uint32_t number) {
    FaceSet set;
    const glm::dvec3 across =
        glm::cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
    const double size = glm::length(across);
    set.largest = number;
    set.area = 0.5 * size;
    set.largest_area = set.area;
    set.axis = size > 0.0 ? across / size : glm::dvec3(0.0);
    set.normal = set.area * set.axis;
    const glm::dvec3 colour(face.colour);
    set.colour = set.area * colour;
    set.squared_colour = set.area * glm::dot(colour, colour);
    const glm::dvec3 middle = (face.corners[0] + face.corners[1] + face.corners[2]) / 3.0;
    set.place = set.area * middle;
    set.squared_place = set.area * glm::dot(middle, middle);
    for (const glm::dvec3& corner : face.corners) {
        // Of a triangle the mean square is a twelfth of the corners' about the middle.
        const glm::dvec3 from_middle = corner - middle;
        set.squared_place += set.area * glm::dot(from_middle, from_middle) / 12.0;
        set.low = glm::min(set.low, corner);
        set.high = glm::max(set.high, corner);
    }
    return set;
}

}  // namespace

FaceSets::FaceSets(const JoinFaces& faces) : faces_(faces) {
    // Places are counted from the middle, so that squares keep their digits.
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    const auto count = static_cast<std::uint32_t>(faces.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        for (const glm::dvec3& corner : faces.at(i).corners) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
    }
    origin_ = 0.5 * (low + high);
    entries_.resize(count);
    std::iota(entries_.begin(), entries_.end(), 0U);
    joined_.reserve(count / 2);  // each has two faces at least
}

FaceSet FaceSets::at(std::uint32_t set) const {
    const std::uint32_t entry = entries_[set];
    if ((entry & several) != 0) {
        return joined_[entry & ~several];
    }
    JoinFace face = faces_.at(entry);
    for (glm::dvec3& corner : face.corners) {
        corner -= origin_;
    }
    return set_of(face, entry);
}

void FaceSets::join(std::uint32_t a, std::uint32_t b) {
    const FaceSet both = joined(at(a), at(b));
    std::uint32_t slot = static_cast<std::uint32_t>(joined_.size());
    if ((entries_[a] & several) != 0) {
        slot = entries_[a] & ~several;
        if ((entries_[b] & several) != 0) {
            free_.push_back(entries_[b] & ~several);
        }
    } else if ((entries_[b] & several) != 0) {
        slot = entries_[b] & ~several;
    } else if (!free_.empty()) {
        slot = free_.back();
        free_.pop_back();
    } else {
        joined_.emplace_back();
    }
    joined_[slot] = both;
    entries_[a] = slot | several;
}

void FaceSets::compact(const std::vector<std::uint32_t>& next) {
    std::uint32_t count = 0;
    for (std::uint32_t set = 0; set < size(); ++set) {
        if (next[set] == count) {
            entries_[count++] = entries_[set];
        }
    }
    entries_.resize(count);
}

}  // namespace raybundle
