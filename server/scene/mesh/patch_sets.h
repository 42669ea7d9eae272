// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace raybundle {

/// Which sides of triangles are one patch, and share their light. Empty where each side is a patch
/// of its own. A patch has sides of one object, one material and one kind, front or back; what is
/// together on the front of two-sided triangles is together on their back.
struct PatchSets {
    std::vector<std::uint32_t> side_patch;  ///< patch of each side
    /// Sides of patch p: members[first[p]] to members[first[p + 1]], the largest first.
    std::vector<std::uint32_t> first, members;
    std::size_t front_count = 0;  ///< patches that are fronts; backs follow

    [[nodiscard]] bool empty() const { return side_patch.empty(); }
};

struct PatchMesh;

/// Patches of a mesh some of whose triangles (`joined`) belong to sets, numbered from 0; empty
/// where all sets are of one triangle.
PatchSets make_patch_sets(const PatchMesh& mesh, const std::vector<std::uint32_t>& joined,
                          const std::vector<std::uint32_t>& sets);

/// Sides of a patch, to be used in a range-based for.
class PatchSides {
  public:
    class Iterator {
      public:
        Iterator(const std::uint32_t* members, std::uint32_t at) : members_(members), at_(at) {}
        std::uint32_t operator*() const { return members_ != nullptr ? members_[at_] : at_; }
        Iterator& operator++() {
            ++at_;
            return *this;
        }
        bool operator==(const Iterator& other) const { return at_ == other.at_; }

      private:
        const std::uint32_t* members_;
        std::uint32_t at_;
    };

    /// One side alone.
    explicit PatchSides(std::uint32_t side) : members_(nullptr), begin_(side), end_(side + 1) {}
    PatchSides(const PatchSets& sets, std::uint32_t patch)
        : members_(sets.members.data()), begin_(sets.first[patch]), end_(sets.first[patch + 1]) {}

    [[nodiscard]] Iterator begin() const { return {members_, begin_}; }
    [[nodiscard]] Iterator end() const { return {members_, end_}; }
    [[nodiscard]] std::size_t size() const { return end_ - begin_; }
    [[nodiscard]] std::uint32_t front() const { return *begin(); }

  private:
    const std::uint32_t* members_;
    std::uint32_t begin_, end_;
};

}  // namespace raybundle
