// SPDX-License-Identifier: Apache-2.0
// End of a special iteration phase for a viewer: the signed increments join the pixels' means; where
// they are uncertain the weight shrinks, as in solution_correct.comp. How uncertain, relative to their size,
// the pixel's patch has measured. No pixel knows its light better than its patch does: what few bundles have not
// brought to a pixel, or not yet, they have to others of the patch.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#ifdef CONSTANT_RADIANCE
#include "facets.glsl"
#endif
#include "pixel_sum.glsl"
#include "corrected_weight.glsl"
layout(binding = UNIT_PIXELS) uniform usamplerBuffer pixel_texels;
layout(std430, binding = BINDING_IRRADIANCE) readonly buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_CHECKPOINT) readonly buffer CheckpointBuffer { vec4 checkpoint[]; };
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
layout(std430, binding = BINDING_PIXEL_IRRADIANCE) buffer PixelIrradianceBuffer { vec4 pixel_irradiance[]; };
layout(std430, binding = BINDING_PIXEL_DELTA) buffer PixelDeltaBuffer { vec4 pixel_delta[]; };
#ifdef GLOSSY
layout(std430, binding = BINDING_PIXEL_GLOSS) buffer PixelGlossBuffer { vec4 pixel_gloss[]; };
layout(std430, binding = BINDING_PIXEL_GLOSS_DELTA) buffer PixelGlossDeltaBuffer { vec4 pixel_gloss_delta[]; };
#endif
uniform float most_weight;    // see solution_correct.comp
uniform float bundles_noise;  // 1/K: variance over square of an increment that the patch has not seen

void main() {
    uint index = linear_index();
    if (index >= view.size.x * view.size.y) {
        return;
    }
    vec3 increment = pixel_delta[index].rgb;
    vec4 sum = pixel_irradiance[index];
    vec3 constant = vec3(0.0);
#ifdef CONSTANT_RADIANCE
    uvec2 surface = texelFetch(pixel_texels, int(2u * index + 1u)).xw;
    constant = constant_share(surface.x, surface.y) * view.constant.rgb;
    sum.rgb += constant;
#endif
    float old_weight = pixel_weight(sum, view.weights.x);
    uint side = texelFetch(pixel_texels, int(2u * index)).w;
    if (side == NO_PATCH || old_weight <= 0.0) {
        return;
    }
    float moved = moved_error(triangle_of_side(side), luminance(pixel_mean(sum, view.weights.x)));
    float most = min(most_weight, irradiance[patch_of_side(side)].w);
    if (increment == vec3(0.0) && old_weight <= most && moved <= 0.0) {
        return;
    }
    float noise = checkpoint[patch_of_side(side)].z;
    noise = noise > 0.0 ? noise : bundles_noise;
    float trusted = trusted_share(noise);
    vec3 mean = max(pixel_mean(sum, view.weights.x) + trusted * increment, 0.0);
    float change = luminance(abs(increment));
    // The common weight stays: a weight below it is a negative one of the pixel's own.
    float value = luminance(mean);
    float error = left_error(noise, bundles_noise, change * change, value) + moved;
    float weight = min(old_weight * kept_weight(old_weight, value, error), most);
    pixel_irradiance[index] = vec4(mean * weight - constant, weight - view.weights.x);
#ifdef GLOSSY
    vec4 gloss = pixel_gloss[index];
    vec3 gloss_mean = pixel_mean(gloss, view.weights.x) + trusted * pixel_gloss_delta[index].rgb;
    float gloss_weight = pixel_weight(gloss, view.weights.x) * (weight / old_weight);
    pixel_gloss[index] = vec4(gloss_mean * gloss_weight, gloss_weight - view.weights.x);
#endif
}
