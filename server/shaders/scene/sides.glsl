// SPDX-License-Identifier: Apache-2.0
// Geometry of the sides of triangles. Requires scene_geometry.glsl and mesh.glsl.

/// Vertices, material and flags of a side's triangle.
uvec4 triangle_of(uint side) { return load_triangle(triangle_of_side(side)); }

/// Unit normal at the present place.
vec3 side_normal(uint side) {
#ifdef PATCH_SETS
    uint triangle = triangle_of_side(side);
    uvec3 v = load_triangle(triangle).xyz;
    vec3 a = world_position(v.x);
    vec3 n = cross(world_position(v.y) - a, world_position(v.z) - a);
    float size = length(n);
    return size > 0.0 ? (side == triangle ? n : -n) / size : vec3(0.0);
#else
    return patch_plane(side).xyz;
#endif
}

uint object_of_triangle(uvec3 triangle) { return floatBitsToUint(texelFetch(world_texels, int(triangle.x)).w); }
