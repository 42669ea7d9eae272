// SPDX-License-Identifier: Apache-2.0
#include "solution/geometry/patch_members.h"

#include <glm/glm.hpp>

#include "gpu/layouts.h"

namespace raybundle {

PatchMembers::PatchMembers(const PatchMesh& mesh) {
    const PatchSets& sets = mesh.patch_sets;
    if (sets.empty()) {
        return;
    }
    defines_.emplace_back("PATCH_SETS 1");
    std::vector<glm::uvec2> sides;
    sides.reserve(mesh.side_count());
    for (std::size_t side = 0; side < mesh.side_count(); ++side) {
        sides.emplace_back(sets.side_patch[side], mesh.side_triangle[side]);
    }
    const auto patches = static_cast<std::uint32_t>(mesh.patch_count());
    std::vector<glm::uvec2> members;
    members.reserve(patches + sets.members.size());
    for (std::uint32_t patch = 0; patch < patches; ++patch) {
        members.emplace_back(patches + sets.first[patch], patches + sets.first[patch + 1]);
    }
    for (const std::uint32_t side : sets.members) {
        members.emplace_back(side, 0U);
    }
    sides_ = Buffer::from<glm::uvec2>("sides", sides);
    members_ = Buffer::from<glm::uvec2>("patch members", members);
    side_texture_ = create_buffer_texture("sides", GL_RG32UI, sides_);
    member_texture_ = create_buffer_texture("patch members", GL_RG32UI, members_);
}

void PatchMembers::bind() const {
    if (!defines_.empty()) {
        glBindTextureUnit(UNIT_SIDES, side_texture_.get());
        glBindTextureUnit(UNIT_MEMBERS, member_texture_.get());
    }
}

void PatchMembers::bind_for_placing() const {
    if (!defines_.empty()) {
        members_.bind_storage(BINDING_MEMBERS);
    }
}

}  // namespace raybundle
