// SPDX-License-Identifier: Apache-2.0
// What triangles round a vertex have in a mean there. Requires mesh.glsl where PATCH_SETS is defined, and `patches`.
#ifdef PATCH_SETS
layout(binding = UNIT_SIDES) uniform usamplerBuffer side_texels;  // patch, triangle

uint patch_of(uint side) { return texelFetch(side_texels, int(side)).x; }

/// Of the triangle itself, whatever its patch has, m^2.
float area_at_vertex(uint triangle) {
    uvec3 v = load_triangle(triangle).xyz;
    vec3 a = world_position(v.x);
    return 0.5 * length(cross(world_position(v.y) - a, world_position(v.z) - a));
}
#else
uint patch_of(uint side) { return side; }

float area_at_vertex(uint triangle) { return patches[triangle].area; }
#endif
