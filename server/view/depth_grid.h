// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "gpu/gl_objects.h"
#include "gpu/readback.h"
#include "gpu/shader_program.h"

namespace raybundle {

/// Depths of a viewer's picture on a coarse grid, on their way from the GPU. Only for viewers who
/// draw the picture from other places, so that nobody else pays for it.
class DepthGrid {
  public:
    /// Points of a grid with so many columns (>= 2) over a picture: cells are about square.
    static glm::uvec2 points_for(std::uint32_t columns, glm::uvec2 picture);

    explicit DepthGrid(glm::uvec2 points);

    [[nodiscard]] glm::uvec2 points() const { return points_; }
    /// Queues the depths of a picture. depths: of its raster, reversed, near_distance (m) at the
    /// front.
    void request(const ShaderProgram& program, const Texture2D& depths, glm::uvec2 picture,
                 float near_distance);
    [[nodiscard]] bool ready() const { return readback_.ready(); }
    /// Inverse depths as DepthMap has them; waits where they are not there yet.
    std::span<const float> take() { return readback_.take_as<float>(); }
    [[nodiscard]] std::size_t bytes() const { return inverse_.bytes(); }

  private:
    glm::uvec2 points_;
    Buffer inverse_;
    Readback readback_;
};

}  // namespace raybundle
