// SPDX-License-Identifier: Apache-2.0
// Plane and area of all patches at one place of the objects.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_WORLD_POSITIONS) readonly buffer WorldBuffer { vec4 world[]; };
layout(std430, binding = BINDING_TRIANGLES) readonly buffer TriangleBuffer { uvec4 triangles[]; };
layout(std430, binding = BINDING_PATCH_TRIANGLE) readonly buffer PatchTriangleBuffer {
    uint patch_triangle[];
};
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_PATCHES) writeonly buffer PatchBuffer { PatchGeometry patches[]; };
uniform uint place;
uniform uint vertex_count;
uniform uint patch_count;
uniform uint triangle_count;

void main() {
    uint i = linear_index();
    if (i >= patch_count) {
        return;
    }
    uint triangle = patch_triangle[i];
    uvec3 v = triangles[triangle].xyz + place * vertex_count;
    vec4 a = world[v.x];
    vec3 n = cross(world[v.y].xyz - a.xyz, world[v.z].xyz - a.xyz);
    float twice_area = length(n);
    n = twice_area > 0.0 ? n / twice_area : vec3(0.0);
    if (i >= triangle_count) {
        n = -n;  // the back side of a double-sided triangle
    }
    PatchGeometry g;
    g.normal = n;
    g.offset = dot(n, (a.xyz + world[v.y].xyz + world[v.z].xyz) / 3.0);
    g.area = 0.5 * twice_area * surfaces[i].albedo.w;
    g.inverse_area = g.area > 0.0 ? 1.0 / g.area : 0.0;
    g.object = floatBitsToUint(a.w);
    g.triangle = triangle;
    patches[place * patch_count + i] = g;
}
