// SPDX-License-Identifier: Apache-2.0
#include "view/depth_grid.h"

#include <algorithm>
#include <cmath>

#include "gpu/gl_scope.h"
#include "gpu/layouts.h"

namespace raybundle {

namespace {

std::size_t bytes_of(glm::uvec2 points) {
    return std::size_t{points.x} * points.y * sizeof(float);
}

}  // namespace

glm::uvec2 DepthGrid::points_for(std::uint32_t columns, glm::uvec2 picture) {
    columns = std::clamp(columns, 2U, std::max(picture.x, 2U));
    const double cell = static_cast<double>(picture.x) / (columns - 1);
    const auto cells = std::lround(static_cast<double>(picture.y) / std::max(cell, 1.0));
    return {columns, static_cast<std::uint32_t>(std::clamp(cells, 1L, 1023L)) + 1U};
}

DepthGrid::DepthGrid(glm::uvec2 points)
    : points_(points),
      inverse_("inverse depths", bytes_of(points)),
      readback_("inverse depths readback", bytes_of(points)) {}

void DepthGrid::request(const ShaderProgram& program, const Texture2D& depths, glm::uvec2 picture,
                        float near_distance) {
    const GlScope scope("view depths");
    inverse_.bind_storage(BINDING_FRAME);
    glBindTextureUnit(UNIT_DEPTHS, depths.get());
    program.set("columns", points_.x);
    program.set("rows", points_.y);
    program.set("width", picture.x);
    program.set("height", picture.y);
    program.set("near_distance", near_distance);
    program.dispatch(std::size_t{points_.x} * points_.y);
    readback_.request(inverse_, bytes_of(points_));
}

}  // namespace raybundle
