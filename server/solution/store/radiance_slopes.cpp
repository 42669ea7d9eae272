// SPDX-License-Identifier: Apache-2.0
#include "solution/store/radiance_slopes.h"

namespace raybundle {

RadianceSlopes::RadianceSlopes(const GpuScene& scene)
    : vertex_light_("vertex light",
                    std::size_t{scene.vertex_count()} * sizeof(layout::VertexLight)),
      slopes_("radiance slopes", std::size_t{scene.patch_count()} * sizeof(layout::RadianceSlope)),
      texture_(create_buffer_texture("radiance slopes", GL_RGBA32UI, slopes_)),
      gather_at_vertices_({"solution_vertex_light.comp"}, scene.set_defines()),
      find_slopes_({"solution_radiance_slopes.comp"}, scene.set_defines()) {
    slopes_.clear();
}

void RadianceSlopes::bind() const {
    glBindTextureUnit(UNIT_SLOPES, texture_.get());
}

void RadianceSlopes::refresh(const GpuScene& scene) const {
    vertex_light_.bind_storage(BINDING_VERTEX_LIGHT);
    gather_at_vertices_.set("vertex_count", scene.vertex_count());
    gather_at_vertices_.dispatch(scene.vertex_count());
    slopes_.bind_storage(BINDING_SLOPES);
    find_slopes_.set("patch_count", scene.patch_count());
    find_slopes_.set("front_count", scene.front_patch_count());
    find_slopes_.dispatch(scene.patch_count());
}

}  // namespace raybundle
