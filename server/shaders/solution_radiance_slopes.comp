// SPDX-License-Identifier: Apache-2.0
// How the radiance of each patch changes from corner to corner (radiance_slope.glsl). The mean irradiance of the patches
// round a corner is that of their common middle, which at the rim of a surface lies beside the corner: c, the linear
// function's values at the corners, follow from  B c = e  with the middles' barycentric coordinates as the rows of B and
// these means as e. Where the middles lie nearly on a line, or are one point, e itself is the better answer:
// c = (B^T B + q I)^-1 (B^T e + q e).
//
// Where light ends within a patch such a function can fall below zero: there the slope is cut down, as the limiters of
// finite volumes do (van Leer 1979), per colour. The light of punctual lights, of caustics, and what glossy patches
// send beside their main part have no slopes.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "mesh.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_PATCH_TRIANGLE) readonly buffer PatchTriangleBuffer { uint patch_triangle[]; };
layout(std430, binding = BINDING_IRRADIANCE) readonly buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_VERTEX_LIGHT) readonly buffer VertexLightBuffer { VertexLight lights[]; };
layout(std430, binding = BINDING_SLOPES) writeonly buffer SlopeBuffer { RadianceSlope slopes[]; };
uniform uint patch_count;
uniform uint triangle_count;

const float inverse_pi = 0.31830988618;
const float largest = 65000.0;  // of a half
const float regularisation = 0.02;

/// Barycentric coordinates of a point's projection onto a triangle's plane. a: a corner; e1, e2: to the others.
vec3 barycentric(vec3 point, vec3 a, vec3 e1, vec3 e2) {
    vec3 n = cross(e1, e2);
    float inverse_square = 1.0 / max(dot(n, n), 1e-30);
    vec3 p = point - a;
    float w1 = dot(cross(p, e2), n) * inverse_square;
    float w2 = dot(cross(e1, p), n) * inverse_square;
    return vec3(1.0 - w1 - w2, w1, w2);
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= patch_count) {
        return;
    }
    bool behind = i >= triangle_count;
    uvec3 v = load_triangle(patch_triangle[i]).xyz;
    vec3 a = world_position(v.x);
    vec3 e1 = world_position(v.y) - a;
    vec3 e2 = world_position(v.z) - a;
    mat3 rows;  // of B, here columns
    mat3 e;     // a column for each corner, a row for each colour
    for (int k = 0; k < 3; ++k) {
        VertexLight light = lights[v[k]];
        rows[k] = barycentric(light.middle, a, e1, e2);
        vec2 b_and_r = unpackHalf2x16(light.front_b_back_r);
        e[k] = behind ? vec3(b_and_r.y, unpackHalf2x16(light.back_gb))
                      : vec3(unpackHalf2x16(light.front_rg), b_and_r.x);
    }
    mat3 q = mat3(regularisation);
    mat3 c = (e * transpose(rows) + regularisation * e) * inverse(rows * transpose(rows) + q);
    vec3 mean = (c[0] + c[1] + c[2]) / 3.0;
    vec3 deepest = mean - min(min(c[0], c[1]), c[2]);
    vec3 kept = clamp(irradiance[i].rgb / max(deepest, 1e-20), 0.0, 1.0);
    vec3 factor = kept * surfaces[i].albedo.rgb * inverse_pi;
    vec3 corner1 = clamp(factor * (c[1] - mean), -largest, largest);
    vec3 corner2 = clamp(factor * (c[2] - mean), -largest, largest);
    slopes[i] = RadianceSlope(packHalf2x16(corner1.rg), packHalf2x16(vec2(corner1.b, corner2.r)),
                              packHalf2x16(corner2.gb), 0u);
}
