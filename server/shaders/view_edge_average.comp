// SPDX-License-Identifier: Apache-2.0
// Antialiasing of a viewer's picture at rest: edge pixels become the mean of what their sub-samples show.
// Variants: LINEAR averages radiance, without it displayed light (a mean of radiance would leave the edges of
// lamps jagged that are many times brighter than display white).
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "edge_counts.glsl"
layout(std430, binding = BINDING_EDGE_COUNTS) readonly buffer EdgeCountBuffer { uint edge_counts[]; };
#ifdef LINEAR
#define TEXEL vec4
#else
#define TEXEL uint
#endif
layout(std430, binding = BINDING_FRAME) readonly buffer FrameBuffer { TEXEL frame[]; };
layout(std430, binding = BINDING_SMOOTHED) writeonly buffer SmoothedBuffer { TEXEL smoothed[]; };
uniform uint width;
uniform uint height;

#ifdef LINEAR
vec4 light_of(TEXEL texel) { return texel; }
TEXEL texel_of(vec4 light) { return light; }
#else
// IEC 61966-2-1 (sRGB).
vec4 light_of(TEXEL texel) {
    vec4 s = unpackUnorm4x8(texel);
    return mix(s / 12.92, pow((s + 0.055) / 1.055, vec4(2.4)), step(0.04045, s));
}
TEXEL texel_of(vec4 light) {
    return packUnorm4x8(mix(light * 12.92, 1.055 * pow(light, vec4(1.0 / 2.4)) - 0.055, step(0.0031308, light)));
}
#endif

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= width * height) {
        return;
    }
    uint row = index / width;  // from the top; counts are kept from the bottom
    uint counts = edge_counts[(height - 1u - row) * width + (index - row * width)];
    TEXEL texel = frame[index];
    for (bool edge = counts != 0u; edge; edge = false) {
        vec4 sum = vec4(0.0);
        uint own = EDGE_SAMPLES;
        for (uint k = 0u; k < 8u; ++k) {
            uint n = edge_count(counts, k);
            ivec2 to = edge_neighbour(k);
            int source = n == 0u ? int(index) : int(index) + to.x - to.y * int(width);
            sum += float(n) * light_of(frame[source]);
            own -= n;
        }
        texel = texel_of((sum + float(own) * light_of(texel)) / float(EDGE_SAMPLES));
    }
    smoothed[index] = texel;
}
