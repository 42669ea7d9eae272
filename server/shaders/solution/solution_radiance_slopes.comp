// SPDX-License-Identifier: Apache-2.0
// How the radiance of each patch changes from corner to corner (radiance_slope.glsl). The mean irradiance of the patches
// round a corner is that of their common middle, which at the rim of a surface lies beside the corner. The gradient is
// fitted to the three middles, by least squares; where they lie nearly on a line it is that along the line (Tikhonov).
//
// Where light ends within a patch such a function can fall below zero: there the slope is cut down, as the limiters of
// finite volumes do (van Leer 1979), per colour. The light of punctual lights, of caustics, what comes through from the
// other side, and what glossy patches send beside their main part have no slopes.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "mesh.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
layout(std430, binding = BINDING_PATCH_TRIANGLE) readonly buffer PatchTriangleBuffer { uint patch_triangle[]; };
layout(std430, binding = BINDING_IRRADIANCE) readonly buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_VERTEX_LIGHT) readonly buffer VertexLightBuffer { VertexLight lights[]; };
layout(std430, binding = BINDING_SLOPES) writeonly buffer SlopeBuffer { RadianceSlope slopes[]; };
uniform uint patch_count;
uniform uint front_count;  // patches that are fronts
#include "patch_members.glsl"

const float inverse_pi = 0.31830988618;
const float largest = 65000.0;  // of a half
const float regularisation = 0.002;  // of the corners' squared distances: patches are seldom narrower than that

/// Places in a patch's plane, in units of the patch's size.
struct Plane {
    vec3 origin;
    vec3 x;
    vec3 y;
};

Plane plane_of(vec3 origin, vec3 normal, float size) {
    vec3 x = normalize(cross(abs(normal.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 1, 0), normal)) / size;
    return Plane(origin, x, cross(normal, x));
}

vec2 place_in(Plane plane, vec3 point) { return vec2(dot(point - plane.origin, plane.x), dot(point - plane.origin, plane.y)); }

void main() {
    uint i = linear_index();
    if (i >= patch_count) {
        return;
    }
    bool behind = i >= front_count;
    if (member_count(i) > 1u) {
        slopes[i] = RadianceSlope(0u, 0u, 0u, 0u);
        return;
    }
    uvec3 v = load_triangle(patch_triangle[i]).xyz;
    vec3 a = world_position(v.x);
    vec3 b = world_position(v.y);
    vec3 c = world_position(v.z);
    vec3 centre = (a + b + c) / 3.0;
    float size = sqrt(dot(a - centre, a - centre) + dot(b - centre, b - centre) + dot(c - centre, c - centre));
    Plane plane = plane_of(centre, patches[i].normal, max(size, 1e-12));
    vec2 corner[3] = vec2[3](place_in(plane, a), place_in(plane, b), place_in(plane, c));
    vec2 middle[3];
    vec3 light[3];
    for (int k = 0; k < 3; ++k) {
        VertexLight at = lights[v[k]];
        middle[k] = place_in(plane, at.middle);
        vec2 b_and_r = unpackHalf2x16(at.front_b_back_r);
        light[k] = behind ? vec3(b_and_r.y, unpackHalf2x16(at.back_gb)) : vec3(unpackHalf2x16(at.front_rg), b_and_r.x);
    }
    vec2 mean_middle = (middle[0] + middle[1] + middle[2]) / 3.0;
    vec3 mean_light = (light[0] + light[1] + light[2]) / 3.0;
    vec3 moments = vec3(regularisation, regularisation, 0.0);  // xx, yy, xy
    vec3 by_x = vec3(0.0);
    vec3 by_y = vec3(0.0);
    for (int k = 0; k < 3; ++k) {
        vec2 m = middle[k] - mean_middle;
        vec3 difference = light[k] - mean_light;
        moments += vec3(m.x * m.x, m.y * m.y, m.x * m.y);
        by_x += m.x * difference;
        by_y += m.y * difference;
    }
    float least = regularisation * (moments.x + moments.y - regularisation);  // but for rounding
    float determinant = max(moments.x * moments.y - moments.z * moments.z, least);
    vec3 gradient_x = (moments.y * by_x - moments.z * by_y) / determinant;
    vec3 gradient_y = (moments.x * by_y - moments.z * by_x) / determinant;
    vec3 rise[3];  // from the patch's middle
    for (int k = 0; k < 3; ++k) {
        rise[k] = gradient_x * corner[k].x + gradient_y * corner[k].y;
    }
    vec3 deepest = -min(min(rise[0], rise[1]), rise[2]);
    vec3 kept = clamp(irradiance[i].rgb / max(deepest, 1e-20), 0.0, 1.0);
    vec3 factor = kept * surfaces[i].albedo.rgb * inverse_pi;
    vec3 corner1 = factor * rise[1];
    vec3 corner2 = factor * rise[2];
    vec3 greatest = max(abs(corner1), abs(corner2));
    // An object without size has no normals, and no slopes.
    bool finite = size > 0.0 && max(greatest.r, max(greatest.g, greatest.b)) < largest;
    corner1 = finite ? corner1 : vec3(0.0);
    corner2 = finite ? corner2 : vec3(0.0);
    slopes[i] = RadianceSlope(packHalf2x16(corner1.rg), packHalf2x16(vec2(corner1.b, corner2.r)),
                              packHalf2x16(corner2.gb), 0u);
}
