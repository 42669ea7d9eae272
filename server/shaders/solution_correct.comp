// SPDX-License-Identifier: Apache-2.0
// End of a special iteration phase (ch. 7.4): adds the averaged increments to the mean and to the
// iterate. An increment from K bundles has an error of about its own size / sqrt(K); relative to the
// value that is worth K/q^2 samples for an increment of relative size q. So where much has changed new
// samples soon dominate; elsewhere value and weight stay.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "accumulator.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
#include "patch_source.glsl"
layout(std430, binding = BINDING_RADIANCE) buffer RadianceBuffer { vec4 radiance[]; };
layout(std430, binding = BINDING_IRRADIANCE) buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_SOURCE) buffer SourceBuffer { vec4 source[]; };
layout(std430, binding = BINDING_CHECKPOINT) buffer CheckpointBuffer { vec2 checkpoint[]; };
#ifdef GLOSSY
#include "gloss.glsl"
layout(std430, binding = BINDING_GLOSS) buffer GlossBuffer { uvec4 gloss[]; };
layout(std430, binding = BINDING_CHAIN) buffer ChainBuffer { vec2 chain[]; };
#endif
uniform uint patch_count;
uniform float phase_weight;  // K, in units of the samples' weight

const float inverse_pi = 0.31830988618;

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= patch_count) {
        return;
    }
    vec3 increment = vec3(take_accumulated(i, 0u), take_accumulated(i, 1u), take_accumulated(i, 2u));
    if (increment == vec3(0.0)) {
        return;
    }
    vec4 mean = irradiance[i];
    float before = luminance(mean.rgb);
    float change = luminance(abs(increment));
    mean.rgb = max(mean.rgb + increment, 0.0);
    float q = before > 0.0 ? min(change / before, 1.0) : 1.0;
    mean.w /= 1.0 + mean.w * q * q / phase_weight;
    checkpoint[i].y = mean.w;
    irradiance[i] = mean;
    vec4 iterate = source[i];
    iterate.rgb = max(iterate.rgb + increment, 0.0);
    source[i] = iterate;
    vec3 emitted = patch_source(i);
    vec3 reflected = surfaces[i].albedo.rgb * iterate.rgb * inverse_pi;
#ifdef GLOSSY
    for (bool glossy = is_glossy(i); glossy; glossy = false) {
        reflected = max(radiance[i].rgb - emitted + surfaces[i].albedo.rgb * increment * inverse_pi, 0.0);
        // The glossy part keeps its share of the light. Its chain starts anew the more the light has changed: an
        // old bright sample would block acceptance.
        float share = before > 0.0 ? clamp(luminance(mean.rgb) / before, 0.0, 4.0) : 0.0;
        gloss[i].y = floatBitsToUint(share * uintBitsToFloat(gloss[i].y));
        chain[i] = vec2(chain[i].x * (1.0 - q), chain[i].y * share);
    }
#endif
    radiance[i].rgb = emitted + reflected;
}
