// SPDX-License-Identifier: Apache-2.0
// Light at vertices as browsers draw with it: irradiance / pi of what view_vertex_irradiance.comp has found, in the order
// that they have it, three channels with 9 bits each and one exponent of 5 (walkthrough/quantise.h).
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_VERTEX_IRRADIANCE) readonly buffer VertexIrradianceBuffer { uvec2 vertex_irradiance[]; };
layout(std430, binding = BINDING_LIGHT_SOURCES) readonly buffer LightSourceBuffer { uint sources[]; };
layout(std430, binding = BINDING_LIGHT_VALUES) writeonly buffer LightValueBuffer { uint values[]; };
uniform uint value_count;
uniform float scale;  // from radiance units of irradiance to units of the values

uint rgb9e5(vec3 colour) {
    const float largest = 65408.0;
    vec3 c = clamp(colour, vec3(0.0), vec3(largest));
    float most = max(c.r, max(c.g, c.b));
    if (!(most > 0.0)) {
        return 0u;
    }
    int whole;
    frexp(most, whole);  // most is below 2^whole, and at least half of that
    int exponent = max(whole, -15) + 15;
    float unit = exp2(float(exponent) - 24.0);
    if (floor(most / unit + 0.5) >= 512.0) {
        ++exponent;
        unit *= 2.0;
    }
    uvec3 mantissa = uvec3(floor(c / unit + 0.5));
    return mantissa.r | mantissa.g << 9u | mantissa.b << 18u | uint(exponent) << 27u;
}

void main() {
    uint i = linear_index();
    if (i >= value_count) {
        return;
    }
    uvec2 halves = vertex_irradiance[sources[i]];
    values[i] = rgb9e5(scale * vec3(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y).x));
}
