// SPDX-License-Identifier: Apache-2.0
// Multiplies the solution by a colour: all emission has changed by these factors, or the unit of radiance
// has. Transport is linear, so nothing else is to be done. What is emitted is set elsewhere.
#include "layouts.glsl"
#include "rarely.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_RADIANCE) buffer RadianceBuffer { vec4 radiance[]; };
layout(std430, binding = BINDING_IRRADIANCE) buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_SOURCE) buffer SourceBuffer { vec4 source[]; };
layout(std430, binding = BINDING_BALANCE) buffer BalanceBuffer { Balance balance; };
#ifdef GLOSSY
#include "gloss.glsl"
layout(std430, binding = BINDING_GLOSS) buffer GlossBuffer { uvec4 gloss[]; };
layout(std430, binding = BINDING_CHAIN) buffer ChainBuffer { vec2 chain[]; };
#endif
uniform uint patch_count;
uniform vec3 factor;

void main() {
    uint i = linear_index();
    if (i == 0u) {
        balance.escaped.rgb *= factor;
        balance.outgoing.rgb *= factor;
    }
    if (i >= patch_count) {
        return;
    }
    radiance[i].rgb *= factor;
    irradiance[i].rgb *= factor;
    source[i].rgb *= factor;
#ifdef GLOSSY
    RARELY(is_glossy(i)) {
        gloss[i] = pack_gloss(factor * gloss_scale(gloss[i]), gloss_source(gloss[i]));
        chain[i] *= max(factor.r, max(factor.g, factor.b));
    }
#endif
}
