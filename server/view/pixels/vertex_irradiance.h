// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "gpu/gl_objects.h"
#include "gpu/shader_program.h"

namespace raybundle {

/// The light of patches at the vertices of the scene, which pixels interpolate between: irradiance
/// on both sides, radiance units, 4 half floats each.
class VertexIrradiance {
  public:
    explicit VertexIrradiance(std::uint32_t vertices);

    void bind() const;
    /// Finds it anew from the present solution, which is bound. program:
    /// view_vertex_irradiance.comp.
    void interpolate(const ShaderProgram& program) const;
    [[nodiscard]] std::size_t bytes() const { return irradiance_.bytes(); }

  private:
    std::uint32_t vertices_;
    Buffer irradiance_;
    Texture2D texture_;
};

}  // namespace raybundle
