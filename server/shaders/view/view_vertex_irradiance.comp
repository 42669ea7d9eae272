// SPDX-License-Identifier: Apache-2.0
// Irradiance at vertices: area-weighted mean over the patches of the vertex's smoothing group, for
// interpolation in the picture (Gouraud). Variant PATCHES_ONLY: with all else that patches receive, by punctual lights
// and caustics, which pixels otherwise find for themselves.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#ifdef PATCH_SETS
#include "mesh.glsl"
#endif
layout(std430, binding = BINDING_VERTEX_DATA) readonly buffer VertexDataBuffer { VertexData vertices[]; };
layout(std430, binding = BINDING_VERTEX_TRIANGLES) readonly buffer VertexTriangleBuffer { uint vertex_triangles[]; };
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
layout(std430, binding = BINDING_IRRADIANCE) readonly buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_BACK_SIDE) readonly buffer BackSideBuffer { uint back_side[]; };
layout(std430, binding = BINDING_VERTEX_IRRADIANCE) writeonly buffer VertexIrradianceBuffer { uvec2 vertex_irradiance[]; };
#if defined(PATCHES_ONLY) && defined(FIRST_SHOT)
layout(std430, binding = BINDING_FIRST_SHOT) readonly buffer FirstShotBuffer { vec4 first_shot[]; };
#endif
#if defined(PATCHES_ONLY) && defined(CAUSTICS)
layout(std430, binding = BINDING_CAUSTIC_IRRADIANCE) readonly buffer CausticIrradianceBuffer {
    vec4 caustic_irradiance[];
};
#endif
uniform uint vertex_count;
#include "vertex_shares.glsl"

/// Half floats (radiance units are near 1 by choice of the unit).
uvec2 pack_irradiance(vec3 e) {
    e = min(e, 65000.0);
    return uvec2(packHalf2x16(e.rg), packHalf2x16(vec2(e.b, 0.0)));
}

vec3 light_of(uint patch_id) {
    vec3 light = irradiance[patch_id].rgb;
#if defined(PATCHES_ONLY) && defined(FIRST_SHOT)
    light += first_shot[2u * patch_id].rgb;
#endif
#if defined(PATCHES_ONLY) && defined(CAUSTICS)
    light = max(light + caustic_irradiance[patch_id].rgb, 0.0);
#endif
    return light;
}

void main() {
    uint i = linear_index();
    if (i >= vertex_count) {
        return;
    }
    vec3 front = vec3(0.0);
    vec3 back = vec3(0.0);
    float front_area = 0.0;
    float back_area = 0.0;
    uint end = vertices[i].first_triangle + vertices[i].triangle_count;
    for (uint k = vertices[i].first_triangle; k < end; ++k) {
        uint triangle = vertex_triangles[k];
        float area = area_at_vertex(triangle);
        front += area * light_of(patch_of(triangle));
        front_area += area;
        uint twin = back_side[triangle];
        if (twin != NO_PATCH) {
            back += area * light_of(patch_of(twin));
            back_area += area;
        }
    }
    vertex_irradiance[2u * i] = pack_irradiance(front_area > 0.0 ? front / front_area : vec3(0.0));
    vertex_irradiance[2u * i + 1u] = pack_irradiance(back_area > 0.0 ? back / back_area : vec3(0.0));
}
