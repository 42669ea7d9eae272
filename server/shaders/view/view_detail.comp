// SPDX-License-Identifier: Apache-2.0
// How much of a picture is finer than its pixels, for the discretisation part of its error, emitters and the 8 pixels
// around them left out. Partial sums in a fixed order, behind those of view_statistics.comp:
//  x: squared difference that smoothing makes at edges
//  y: squared second difference between other pixels and their four neighbours, none of them at an edge; where
//     places in pixels are staggered a part of the first difference is in it
//  z: squared radiance
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "group_sum.glsl"
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
layout(binding = UNIT_PIXELS) uniform usamplerBuffer pixel_texels;
layout(std430, binding = BINDING_FRAME) readonly buffer FrameBuffer { vec4 frame[]; };           // not smoothed, row 0 at the top
layout(std430, binding = BINDING_SMOOTHED) readonly buffer SmoothedBuffer { vec4 smoothed[]; };  // or the same
layout(std430, binding = BINDING_STATISTICS) writeonly buffer StatisticsBuffer { vec4 partial[]; };

const uint nothing = 0u;
const uint surface = 1u;
const uint emitter = 2u;

/// What a pixel shows. at: row 0 at the top; outside: nothing.
uint shown(ivec2 at) {
    if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(view.size.xy)))) {
        return nothing;
    }
    int index = (int(view.size.y) - 1 - at.y) * int(view.size.x) + at.x;
    if (texelFetch(pixel_texels, 2 * index).w == NO_PATCH) {
        return nothing;
    }
#ifdef IES
    if (frame[at.y * int(view.size.x) + at.x].w < 1.0) {
        return emitter;  // a luminaire
    }
#endif
    uint facet = texelFetch(pixel_texels, 2 * index + 1).w;
    return (facet & (PIXEL_EMITTER | PIXEL_UNLIT)) != 0u ? emitter : surface;
}

vec4 detail(uint index) {
    ivec2 size = ivec2(view.size.xy);
    ivec2 at = ivec2(int(index) % size.x, int(index) / size.x);
    if (shown(at) != surface) {
        return vec4(0.0);
    }
    bool inside = true;
    vec3 mean = vec3(0.0);
    for (int k = 0; k < 9; ++k) {
        ivec2 offset = ivec2(k % 3, k / 3) - 1;
        uint what = shown(at + offset);
        if (what == emitter) {
            return vec4(0.0);
        }
        if (abs(offset.x) + abs(offset.y) == 1) {
            uint to = uint(clamp(int(index) + offset.y * size.x + offset.x, 0, size.x * size.y - 1));
            inside = inside && what == surface && smoothed[to].rgb == frame[to].rgb;
            mean += 0.25 * frame[to].rgb;
        }
    }
    vec3 centre = frame[index].rgb;
    vec3 smoothing = smoothed[index].rgb - centre;
    bool between = smoothing == vec3(0.0) && inside;
    return vec4(dot(smoothing, smoothing), between ? dot(centre - mean, centre - mean) : 0.0,
                dot(centre, centre), 0.0);
}

void main() {
    uint pixels = view.size.x * view.size.y;
    vec4 sum = vec4(0.0);
    for (uint index = gl_GlobalInvocationID.x; index < pixels; index += gl_NumWorkGroups.x * 64u) {
        sum += detail(index);
    }
    vec4 total = group_sum(sum);
    if (gl_LocalInvocationID.x == 0u) {
        partial[gl_NumWorkGroups.x + gl_WorkGroupID.x] = total;
    }
}
