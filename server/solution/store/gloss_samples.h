// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "gpu/gl_objects.h"
#include "gpu/shader_program.h"

namespace raybundle {

/// The random representation of what glossy patches send: directions that light has come from.
/// Nothing where no patch is glossy. Written by updates, read by bundles.
class GlossSamples {
  public:
    GlossSamples(std::uint32_t patch_count, bool any_glossy);

    void bind() const;
    /// An object has turned: its patches keep the directions of their light.
    void turn(std::uint32_t object, const glm::mat4& now_from_before) const;
    [[nodiscard]] bool any() const { return gloss_.bytes() > 0; }
    [[nodiscard]] std::size_t bytes() const { return gloss_.bytes() + chain_.bytes(); }

  private:
    std::uint32_t patch_count_;
    Buffer gloss_, chain_;
    Texture2D texture_;
    ShaderProgram turn_;
};

}  // namespace raybundle
