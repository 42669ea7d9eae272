// SPDX-License-Identifier: Apache-2.0
// Antialiasing of a viewer's picture at rest: edge pixels become the mean of what their sub-samples show:
// what pixels show, or of strangers (edge_counts.glsl) what the solution in object space knows.
// Variants: LINEAR averages radiance, without it displayed light (a mean of radiance would leave the edges of
// lamps jagged that are many times brighter than display white). Runs on the tiles with edges alone.
#include "layouts.glsl"
layout(local_size_x = VIEW_TILE, local_size_y = VIEW_TILE) in;
#define OBJECT_SPACE_RADIANCE 1
#include "view_radiance.glsl"
#include "tone_curve.glsl"
#define TILE_LISTS 1
#define TILES_ACCESS readonly
#include "tiles.glsl"
#include "edge_counts.glsl"
layout(std430, binding = BINDING_EDGE_COUNTS) readonly buffer EdgeCountBuffer { uint edge_counts[]; };
#ifdef LINEAR
#define TEXEL vec4
#else
#define TEXEL uint
#endif
layout(std430, binding = BINDING_FRAME) readonly buffer FrameBuffer { TEXEL frame[]; };
layout(std430, binding = BINDING_SMOOTHED) writeonly buffer SmoothedBuffer { TEXEL smoothed[]; };

#ifdef LINEAR
vec4 light_of(TEXEL texel) { return texel; }
TEXEL texel_of(vec4 light) { return light; }
#else
// IEC 61966-2-1 (sRGB).
vec4 light_of(TEXEL texel) {
    vec3 s = unpackUnorm4x8(texel).rgb;
    return vec4(mix(s / 12.92, pow((s + 0.055) / 1.055, vec3(2.4)), step(0.04045, s)), 1.0);
}
TEXEL texel_of(vec4 light) {
    vec3 l = light.rgb;
    return packUnorm4x8(vec4(mix(l * 12.92, 1.055 * pow(l, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, l)), 1.0));
}
#endif

#ifdef LINEAR
vec4 light_of_radiance(vec3 radiance) { return vec4(radiance * view.display.x, 1.0); }
#else
vec4 light_of_radiance(vec3 radiance) { return vec4(clamp(shoulder(radiance * view.display.y), 0.0, 1.0), 1.0); }
#endif

uniform bool with_strangers;  // else they count as the pixel's own

void main() {
    uvec2 at = tile_pixel(tile_of_group(true, 0u), gl_LocalInvocationIndex);
    if (at.x >= view.size.x || at.y >= view.size.y) {
        return;
    }
    int width = int(view.size.x);
    int index = int(view.size.y - 1u - at.y) * width + int(at.x);  // counts are kept from the bottom, frames from the top
    uint pixel = at.y * view.size.x + at.x;
    uint counts = edge_counts[2u * pixel];
    uint strangers = edge_counts[2u * pixel + 1u];
    RARELY((counts | strangers) != 0u) {
        vec4 sum = vec4(0.0);
        uint own = EDGE_SAMPLES;
        for (uint k = 0u; k < 8u; ++k) {
            uint n = edge_count(counts, k);
            ivec2 to = edge_neighbour(k);
            RARELY(n != 0u) {
                sum += float(n) * light_of(frame[index + to.x - to.y * width]);
            }
            own -= n;
        }
        RARELY(strangers != 0u) {
            uint side = stranger_side(strangers);
            uint id = patch_of_side(side);
            // What has neither light of its own nor a diffuse part (metal, mirrors) is not known here.
            if (with_strangers && surfaces[id].albedo.rgb + surfaces[id].emission.rgb != vec3(0.0)) {
                uint n = stranger_count(strangers);
                sum += float(n) * light_of_radiance(object_space_radiance(side));
                own -= n;
            }
        }
        smoothed[index] = texel_of((sum + float(own) * light_of(frame[index])) / float(EDGE_SAMPLES));
    }
}
