// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "gpu/gl_objects.h"
#include "scene/mesh/patch_mesh.h"

namespace raybundle {

/// The sides of patches on the GPU, where some patches are several triangles; nothing where none
/// is. See shaders/scene/patch_members.glsl.
class PatchMembers {
  public:
    explicit PatchMembers(const PatchMesh& mesh);
    /// PATCH_SETS, or nothing.
    [[nodiscard]] const std::vector<std::string>& defines() const { return defines_; }
    void bind() const;
    /// To be written by scene_place_patches.comp, whose areas they are.
    void bind_for_placing() const;
    [[nodiscard]] std::size_t bytes() const { return sides_.bytes() + members_.bytes(); }

  private:
    std::vector<std::string> defines_;
    Buffer sides_, members_;
    Texture2D side_texture_, member_texture_;
};

}  // namespace raybundle
