// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "scene/mesh/joins/face_set.h"
#include "scene/mesh/joins/join_faces.h"

namespace raybundle {

/// The sets that there are. Those of one face are not kept, but found anew when they are asked for:
/// most faces join others soon.
class FaceSets {
  public:
    /// The faces must outlive it.
    explicit FaceSets(const JoinFaces& faces);

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(entries_.size()); }
    [[nodiscard]] FaceSet at(std::uint32_t set) const;
    /// Face of a set, the largest one.
    [[nodiscard]] std::uint32_t largest(std::uint32_t set) const {
        const std::uint32_t entry = entries_[set];
        return (entry & several) != 0 ? joined_[entry & ~several].largest : entry;
    }
    [[nodiscard]] std::uint32_t kind(std::uint32_t set) const {
        return faces_.kind_of(largest(set));
    }
    [[nodiscard]] std::size_t sides_of(std::uint32_t set) const {
        return faces_.sides_of(largest(set));
    }

    /// Set a becomes both, and b is not to be used until compact().
    void join(std::uint32_t a, std::uint32_t b);
    /// Gives sets their next numbers; those that have gone with a lower one have its.
    void compact(const std::vector<std::uint32_t>& next);

  private:
    static constexpr std::uint32_t several = 0x80000000U;

    const JoinFaces& faces_;
    glm::dvec3 origin_{0.0};
    std::vector<std::uint32_t> entries_;  // a face, or the number of a joined one
    std::vector<FaceSet> joined_;
    std::vector<std::uint32_t> free_;  // of joined_
};

}  // namespace raybundle
