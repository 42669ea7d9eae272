// SPDX-License-Identifier: Apache-2.0
// Read access to triangles and placed vertices.
layout(binding = UNIT_TRIANGLES) uniform usamplerBuffer triangle_texels;
layout(binding = UNIT_WORLD_POSITIONS) uniform samplerBuffer world_texels;

/// Vertex indices, and material and flags.
uvec4 load_triangle(uint triangle) { return texelFetch(triangle_texels, int(triangle)); }

/// World position of a vertex; index: vertex + base of the place.
vec3 world_position(uint index) { return texelFetch(world_texels, int(index)).xyz; }
