// SPDX-License-Identifier: Apache-2.0
#include "view/pixels/vertex_irradiance.h"

#include <glm/glm.hpp>

#include "gpu/layouts.h"

namespace raybundle {

VertexIrradiance::VertexIrradiance(std::uint32_t vertices)
    : vertices_(vertices),
      irradiance_("vertex irradiance", 2 * std::size_t{vertices} * sizeof(glm::uvec2)),
      texture_(create_buffer_texture("vertex irradiance", GL_RGBA16F, irradiance_)) {}

void VertexIrradiance::bind() const {
    irradiance_.bind_storage(BINDING_VERTEX_IRRADIANCE);
    glBindTextureUnit(UNIT_VERTEX_IRRADIANCE, texture_.get());
}

void VertexIrradiance::interpolate(const ShaderProgram& program) const {
    program.set("vertex_count", vertices_);
    program.dispatch(vertices_);
}

}  // namespace raybundle
