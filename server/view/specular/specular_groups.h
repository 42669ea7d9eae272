// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/shader_program.h"

namespace raybundle {

/// The groups of a viewer's pixels that show surfaces with a specular lobe, listed on the GPU while
/// its geometry buffer is made; see specular_groups.glsl. What only they need is dispatched over
/// them alone: a software rasteriser pays for the mere presence of code that no pixel enters.
class SpecularGroups {
  public:
    explicit SpecularGroups(std::size_t pixels);

    void bind() const;
    /// Empties the list.
    void begin() const;
    /// The list is complete.
    void end() const;
    /// Runs a program of local size SPECULAR_GROUP on all listed groups.
    void dispatch(const ShaderProgram& program) const;
    /// How many are listed. Synchronous.
    [[nodiscard]] std::uint32_t count() const;
    [[nodiscard]] std::size_t bytes() const { return list_.bytes() + flags_.bytes(); }

  private:
    Buffer list_, flags_;
    ShaderProgram finish_;
};

}  // namespace raybundle
