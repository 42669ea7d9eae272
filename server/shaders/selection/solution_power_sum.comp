// SPDX-License-Identifier: Apache-2.0
// Puts the iterate to the levels of its zones (zones/zone_levels.h), and sums patch_power over blocks of patches, always in the same order.
#include "layouts.glsl"
#include "rarely.glsl"
layout(local_size_x = POWER_BLOCK) in;
#include "linear_index.glsl"
#include "power.glsl"
layout(std430, binding = BINDING_SOURCE) buffer SourceBuffer { vec4 source[]; };
#ifdef GLOSSY
#include "gloss.glsl"
layout(std430, binding = BINDING_GLOSS) buffer GlossBuffer { uvec4 gloss[]; };
layout(std430, binding = BINDING_CHAIN) buffer ChainBuffer { vec2 chain[]; };
#endif
#ifdef TRANSMISSION
#include "transmission.glsl"
#endif
uniform uint patch_count;
shared vec3 sums[POWER_BLOCK];
void main() {
    uint i = linear_index();
    uint lane = gl_LocalInvocationID.x;
    sums[lane] = vec3(0.0);
    if (i < patch_count) {
#ifndef TRANSMISSION  // else solution_level.comp has
        source[i].rgb = levelled(i, source[i].rgb);
#endif
        vec3 emitted = patch_source(i);
        vec3 reflected = surfaces[i].albedo.rgb * source[i].rgb / pi;
#ifdef TRANSMISSION
        reflected += transmitted_exitance(i) / pi;
#endif
#ifdef GLOSSY
        RARELY(is_glossy(i)) {
            ZoneLevelData level = zone_levels[zones[i]];
            vec3 scale = level.scale.rgb;
            reflected = max(scale * (radiance[i].rgb - emitted) +
                                surfaces[i].albedo.rgb * level.offset.rgb / pi, 0.0);
            gloss[i] = pack_gloss(scale * gloss_scale(gloss[i]), gloss_source(gloss[i]));
            chain[i].y *= max(scale.r, max(scale.g, scale.b));
        }
#endif
        radiance[i].rgb = emitted + reflected;
        sums[lane] = patch_power(i);
    }
    for (uint stride = POWER_BLOCK / 2; stride > 0u; stride /= 2u) {
        barrier();
        if (lane < stride) {
            sums[lane] += sums[lane + stride];
        }
    }
    if (lane == 0u && i < patch_count) {
        blocks[linear_group()].xyz = sums[0];
    }
}
