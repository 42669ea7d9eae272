// SPDX-License-Identifier: Apache-2.0
// End of a special iteration phase (ch. 7.4): adds the averaged increments to the mean and to the iterate.
// The mean of w samples of relative deviation s has the variance s^2 E^2 / w; with the squared error that the
// increment leaves it is worth as much as  w' = 1 / (1/w + error^2 / (s E)^2)  samples. So where much has changed
// for what is left new samples soon dominate; elsewhere value and weight stay.
#include "layouts.glsl"
#include "rarely.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "corrected_weight.glsl"
#include "checkpoint.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
#include "patch_source.glsl"
layout(std430, binding = BINDING_RADIANCE) buffer RadianceBuffer { vec4 radiance[]; };
layout(std430, binding = BINDING_IRRADIANCE) buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_SOURCE) buffer SourceBuffer { vec4 source[]; };
layout(std430, binding = BINDING_CHECKPOINT) buffer CheckpointBuffer { vec4 checkpoint[]; };
layout(std430, binding = BINDING_INCREMENTS) readonly buffer IncrementBuffer { vec4 increments[]; };
#ifdef TRANSMISSION
#include "transmission.glsl"
#endif
#ifdef GLOSSY
#include "gloss.glsl"
layout(std430, binding = BINDING_GLOSS) buffer GlossBuffer { uvec4 gloss[]; };
layout(std430, binding = BINDING_CHAIN) buffer ChainBuffer { vec2 chain[]; };
#endif
uniform uint patch_count;
uniform float most_weight;    // that any patch keeps
uniform float bundles_noise;  // 1/K

const float inverse_pi = 0.31830988618;
const float wrong = 1.5;           // squared error of few bundles over what they say themselves
const float likely_unseen = 0.15;  // of the squared error that most_weight reckons with

void main() {
    uint i = linear_index();
    if (i >= patch_count) {
        return;
    }
    vec2 earlier = unpackHalf2x16(floatBitsToUint(checkpoint[i].w));  // of changes that are not settled
    if (irradiance[i].w > most_weight) {
        irradiance[i].w = most_weight;
        checkpoint[i].w = pack_left(earlier.x, most_weight);
    }
    float moved = moved_error(floatBitsToUint(patch_attributes(i).w), luminance(irradiance[i].rgb));
    if (increments[i].rgb == vec3(0.0) && moved <= 0.0) {
        return;
    }
    float measured = luminance(abs(increments[i].rgb));
    float noise = increments[i].w / max(measured * measured, 1e-30);
    float square = measured * measured;
    float share = moved > 0.0 ? trusted_share_moved(square, increments[i].w, moved) : trusted_share(noise);
    vec3 increment = share * increments[i].rgb;
    vec4 mean = irradiance[i];
    float before = luminance(mean.rgb);
    float change = luminance(abs(increment));
    mean.rgb = max(mean.rgb + increment, 0.0);
    float after = luminance(mean.rgb);
    float error = moved > 0.0 ? left_error_moved(increments[i].w, moved)
                              : left_error(noise, bundles_noise, square, after);
    mean.w *= kept_weight(mean.w, after, error);
    checkpoint[i].z = noise;
    // What the phase leaves, as it is to be expected: few bundles differ by less than they are wrong, and a weight is
    // more careful about what is not seen.
    float unseen = likely_unseen * sample_deviation * sample_deviation * after * after / most_weight;
    float before_this = earlier.x * correction_scale(checkpoint[i], before);
    float left = sqrt(wrong * error + unseen + before_this * before_this) / correction_scale(checkpoint[i], after);
    checkpoint[i].w = pack_left(left, mean.w);
    irradiance[i] = mean;
    vec4 iterate = source[i];
    iterate.rgb = max(iterate.rgb + increment, 0.0);
    source[i] = iterate;
    vec3 emitted = patch_source(i);
    vec3 reflected = surfaces[i].albedo.rgb * iterate.rgb * inverse_pi;
#ifdef TRANSMISSION
    reflected += transmitted_exitance(i) * inverse_pi;  // corrected or not yet: until the next group of bundles
#endif
#ifdef GLOSSY
    RARELY(is_glossy(i)) {
        reflected = max(radiance[i].rgb - emitted + surfaces[i].albedo.rgb * increment * inverse_pi, 0.0);
        // The glossy part keeps its share of the light. Its chain starts anew the more the light has changed: an
        // old bright sample would block acceptance.
        float share = before > 0.0 ? clamp(after / before, 0.0, 4.0) : 0.0;
        float q = before > 0.0 ? min(change / before, 1.0) : 1.0;
        gloss[i].y = floatBitsToUint(share * uintBitsToFloat(gloss[i].y));
        chain[i] = vec2(chain[i].x * (1.0 - q), chain[i].y * share);
    }
#endif
    radiance[i].rgb = emitted + reflected;
}
