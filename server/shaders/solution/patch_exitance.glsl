// SPDX-License-Identifier: Apache-2.0
// Flux per area that a patch sends by its iterate, radiance units: what it reflects, and what it emits. Needs
// `surfaces`, `patches`.
#include "patch_source.glsl"
layout(std430, binding = BINDING_SOURCE) readonly buffer SourceBuffer { vec4 source[]; };
#ifdef TRANSMISSION
#include "transmission.glsl"
#endif
#ifdef GLOSSY
#include "rarely.glsl"
#include "gloss.glsl"
layout(std430, binding = BINDING_RADIANCE) readonly buffer RadianceBuffer { vec4 radiance[]; };
#endif

const float pi = 3.14159265359;

vec3 emitted_exitance(uint i) { return pi * patch_source(i); }

vec3 reflected_exitance(uint i) {
    vec3 reflected = surfaces[i].albedo.rgb * source[i].rgb;
#ifdef TRANSMISSION
    reflected += transmitted_exitance(i);
#endif
#ifdef GLOSSY  // whose albedo is not one number, and whose radiance is of this iterate already
    RARELY(is_glossy(i)) {
        reflected = pi * (radiance[i].rgb - patch_source(i));
    }
#endif
    return reflected;
}
