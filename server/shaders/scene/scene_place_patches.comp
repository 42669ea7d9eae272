// SPDX-License-Identifier: Apache-2.0
// Plane and area of all patches at one place of the objects. PATCH_SETS: of several triangles the middle plane, the sum of
// their areas, and which share of it each one has.
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
uniform uint front_count;  // patches that are fronts
#ifdef PATCH_SETS
layout(std430, binding = BINDING_MEMBERS) buffer MemberBuffer { uvec2 members[]; };
layout(binding = UNIT_SIDES) uniform usamplerBuffer side_texels;

struct Plane {
    vec3 normal;
    vec3 middle;
    float area;
};

/// Notes the running sum of the areas with the members.
Plane plane_of(uvec2 range) {
    vec3 normal = vec3(0.0);
    vec3 moment = vec3(0.0);
    float twice_area = 0.0;
    for (uint k = range.x; k < range.y; ++k) {
        uint side = members[k].x;
        uint triangle = texelFetch(side_texels, int(side)).y;
        uvec3 v = triangles[triangle].xyz + place * vertex_count;
        vec3 a = world[v.x].xyz;
        vec3 n = cross(world[v.y].xyz - a, world[v.z].xyz - a);
        float size = length(n);
        normal += side == triangle ? n : -n;
        moment += size * (a + world[v.y].xyz + world[v.z].xyz) / 3.0;
        twice_area += size;
        members[k].y = floatBitsToUint(twice_area);
    }
    float size = length(normal);
    return Plane(size > 0.0 ? normal / size : vec3(0.0), twice_area > 0.0 ? moment / twice_area : moment,
                 0.5 * twice_area);
}

/// Of several triangles. What has no size keeps the shares that it had.
void place_set(uint i, uvec2 range) {
    Plane plane = plane_of(range);
    float per_area = plane.area > 0.0 ? 0.5 / plane.area : 0.0;
    for (uint k = range.x; k < range.y; ++k) {
        float share = uintBitsToFloat(members[k].y) * per_area;
        members[k].y = floatBitsToUint(per_area > 0.0 ? share : float(k - range.x + 1u) / float(range.y - range.x));
    }
    PatchGeometry g;
    g.normal = plane.normal;
    g.offset = dot(plane.normal, plane.middle);
    g.area = plane.area * surfaces[i].albedo.w;
    g.inverse_area = g.area > 0.0 ? 1.0 / g.area : 0.0;
    g.object = floatBitsToUint(world[triangles[patch_triangle[i]].x].w);
    g.triangle = patch_triangle[i];
    patches[place * patch_count + i] = g;
}
#endif

void main() {
    uint i = linear_index();
    if (i >= patch_count) {
        return;
    }
#ifdef PATCH_SETS
    uvec2 range = members[i];
    if (range.y - range.x > 1u) {
        place_set(i, range);
        return;
    }
#endif
    uint triangle = patch_triangle[i];
    uvec3 v = triangles[triangle].xyz + place * vertex_count;
    vec4 a = world[v.x];
    vec3 n = cross(world[v.y].xyz - a.xyz, world[v.z].xyz - a.xyz);
    float twice_area = length(n);
    n = twice_area > 0.0 ? n / twice_area : vec3(0.0);
    if (i >= front_count) {
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
