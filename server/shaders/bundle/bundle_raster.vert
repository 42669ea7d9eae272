// SPDX-License-Identifier: Apache-2.0
// Places the scene's vertices for a bundle or a viewer.
layout(location = 0) in vec4 world_position;
#ifdef ALPHA_MASK
layout(location = 1) in vec2 vertex_uv;
layout(location = 0) out vec2 mesh_uv;
#endif
uniform mat4 clip_from_world;

void main() {
    gl_Position = clip_from_world * vec4(world_position.xyz, 1.0);
#ifdef ALPHA_MASK
    mesh_uv = vertex_uv;
#endif
}
