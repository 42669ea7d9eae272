// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "gpu/gl_objects.h"
#include "gpu/shader_program.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {

/// How radiance changes within patches; see radiance_slope.glsl. Written from the radiance of the
/// patches between groups of iterations, read by bundles.
class RadianceSlopes {
  public:
    explicit RadianceSlopes(const GpuScene& scene);

    void bind() const;
    /// Follows the radiance that is bound.
    void refresh(const GpuScene& scene) const;
    [[nodiscard]] std::size_t bytes() const { return vertex_light_.bytes() + slopes_.bytes(); }

  private:
    Buffer vertex_light_, slopes_;
    Texture2D texture_;
    ShaderProgram gather_at_vertices_, find_slopes_;
};

}  // namespace raybundle
