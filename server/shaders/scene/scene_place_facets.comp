// SPDX-License-Identifier: Apache-2.0
// Plane and barycentric weights of all facets at one place of the objects.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_WORLD_POSITIONS) readonly buffer WorldBuffer { vec4 world[]; };
layout(std430, binding = BINDING_FACET_INDICES) readonly buffer IndexBuffer { uint indices[]; };
layout(std430, binding = BINDING_FACETS) buffer FacetBuffer { FacetGeometry facets[]; };
uniform uint place;
uniform uint vertex_count;
uniform uint facet_count;

vec4 affine(vec3 gradient, vec3 zero_at) { return vec4(gradient, -dot(gradient, zero_at)); }

void main() {
    uint i = linear_index();
    if (i >= facet_count) {
        return;
    }
    uint base = place * vertex_count;
    vec3 a = world[base + indices[3u * i]].xyz;
    vec3 b = world[base + indices[3u * i + 1u]].xyz;
    vec3 c = world[base + indices[3u * i + 2u]].xyz;
    vec3 n = cross(b - a, c - a);
    float square = dot(n, n);
    vec3 unit = square > 0.0 ? n * inversesqrt(square) : vec3(0.0);
    vec3 scaled = square > 0.0 ? n / square : vec3(0.0);
    uint at = place * facet_count + i;
    facets[at].normal = unit;
    facets[at].offset = dot(unit, (a + b + c) / 3.0);
    facets[at].weight1 = affine(cross(c - a, scaled), a);
    facets[at].weight2 = affine(cross(scaled, b - a), a);
}
