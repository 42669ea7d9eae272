// SPDX-License-Identifier: Apache-2.0
// Adds what the bundles of the start could not carry, RadianceStore::complete_start(), to the mean irradiance and to the
// iterate; of a glossy patch the iterate is the reflected main part itself.
#include "layouts.glsl"
#include "rarely.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_IRRADIANCE) buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_SOURCE) buffer SourceBuffer { vec4 source[]; };
layout(std430, binding = BINDING_COMPLETION) readonly buffer CompletionBuffer { vec4 completion[]; };
#ifdef GLOSSY
#include "power.glsl"
#include "gloss.glsl"
#endif
uniform uint patch_count;

void main() {
    uint i = linear_index();
    if (i >= patch_count) {
        return;
    }
    source[i].rgb += completion[i].rgb;
    if (irradiance[i].w > 0.0) {
        irradiance[i].rgb += completion[i].rgb;
    }
#ifdef GLOSSY
    RARELY(is_glossy(i)) {
        radiance[i].rgb += surfaces[i].albedo.rgb * completion[i].rgb / pi;
    }
#endif
}
