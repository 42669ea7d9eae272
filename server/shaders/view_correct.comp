// SPDX-License-Identifier: Apache-2.0
// End of a special iteration phase for a viewer: the signed increments join the pixels' means; where
// they are large the weight shrinks, as in solution_correct.comp.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "pixel_sum.glsl"
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
layout(std430, binding = BINDING_PIXEL_IRRADIANCE) buffer PixelIrradianceBuffer { vec4 pixel_irradiance[]; };
layout(std430, binding = BINDING_PIXEL_DELTA) buffer PixelDeltaBuffer { vec4 pixel_delta[]; };
#ifdef GLOSSY
layout(std430, binding = BINDING_PIXEL_GLOSS) buffer PixelGlossBuffer { vec4 pixel_gloss[]; };
layout(std430, binding = BINDING_PIXEL_GLOSS_DELTA) buffer PixelGlossDeltaBuffer { vec4 pixel_gloss_delta[]; };
#endif
uniform float phase_weight;  // see solution_correct.comp

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }

void main() {
    uint index = gl_GlobalInvocationID.x;
    if (index >= view.size.x * view.size.y) {
        return;
    }
    vec3 increment = pixel_delta[index].rgb;
    vec4 sum = pixel_irradiance[index];
    float old_weight = pixel_weight(sum, view.weights.x);
    if (increment == vec3(0.0) || old_weight <= 0.0) {
        return;
    }
    vec3 mean = pixel_mean(sum, view.weights.x);
    float before = luminance(mean);
    float change = luminance(abs(increment));
    float q = before > 0.0 ? min(change / before, 1.0) : 1.0;
    // The common weight stays: a weight below it is a negative one of the pixel's own.
    float weight = old_weight / (1.0 + old_weight * q * q / phase_weight);
    pixel_irradiance[index] = vec4(max(mean + increment, 0.0) * weight, weight - view.weights.x);
#ifdef GLOSSY
    vec4 gloss = pixel_gloss[index];
    vec3 gloss_mean = pixel_mean(gloss, view.weights.x) + pixel_gloss_delta[index].rgb;
    float gloss_weight = pixel_weight(gloss, view.weights.x) * (weight / old_weight);
    pixel_gloss[index] = vec4(gloss_mean * gloss_weight, gloss_weight - view.weights.x);
#endif
}
