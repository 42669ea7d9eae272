// SPDX-License-Identifier: Apache-2.0
// What the solution knows of the light round each vertex, for solution_radiance_slopes.comp. Where a wall stands on a
// floor that runs on beneath it, the light above is not that below: patches that are dark beside others are left out.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "luminance.glsl"
#include "mesh.glsl"
layout(std430, binding = BINDING_VERTEX_DATA) readonly buffer VertexDataBuffer { VertexData vertices[]; };
layout(std430, binding = BINDING_VERTEX_TRIANGLES) readonly buffer VertexTriangleBuffer { uint vertex_triangles[]; };
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
layout(std430, binding = BINDING_IRRADIANCE) readonly buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_BACK_SIDE) readonly buffer BackSideBuffer { uint back_side[]; };
layout(std430, binding = BINDING_VERTEX_LIGHT) writeonly buffer VertexLightBuffer { VertexLight lights[]; };
uniform uint vertex_count;
#include "vertex_shares.glsl"

const float largest = 65000.0;  // of a half
const float dark = 0.02;        // of the brightest patch's irradiance

vec3 middle_of(uint triangle) {
    uvec3 v = load_triangle(triangle).xyz;
    return (world_position(v.x) + world_position(v.y) + world_position(v.z)) / 3.0;
}

void main() {
    uint i = linear_index();
    if (i >= vertex_count) {
        return;
    }
    vec3 own = world_position(i);
    vec3 offset = vec3(0.0);
    vec3 front = vec3(0.0);
    vec3 back = vec3(0.0);
    float front_area = 0.0;
    float back_area = 0.0;
    uint end = vertices[i].first_triangle + vertices[i].triangle_count;
    float brightest = 0.0;
    for (uint k = vertices[i].first_triangle; k < end; ++k) {
        brightest = max(brightest, luminance(irradiance[patch_of(vertex_triangles[k])].rgb));
    }
    for (uint k = vertices[i].first_triangle; k < end; ++k) {
        uint triangle = vertex_triangles[k];
        vec3 light = irradiance[patch_of(triangle)].rgb;
        float whole = area_at_vertex(triangle);
        float area = luminance(light) < dark * brightest ? 0.0 : whole;
        offset += area * (middle_of(triangle) - own);
        front += area * light;
        front_area += area;
        uint twin = back_side[triangle];
        if (twin != NO_PATCH) {
            back += whole * irradiance[patch_of(twin)].rgb;
            back_area += whole;
        }
    }
    float per_area = front_area > 0.0 ? 1.0 / front_area : 0.0;
    front = min(per_area * front, largest);
    back = min(back_area > 0.0 ? back / back_area : vec3(0.0), largest);
    lights[i] = VertexLight(own + per_area * offset, packHalf2x16(front.rg), packHalf2x16(vec2(front.b, back.r)),
                            packHalf2x16(back.gb), 0u, 0u);
}
