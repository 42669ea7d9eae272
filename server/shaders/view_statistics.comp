// SPDX-License-Identifier: Apache-2.0
// Partial sums over a viewer's probe pixels, in a fixed order:
//  x: estimated squared error of the shown luminance, from the variance between batch means
//  y: squared luminance, z: logarithm of luminance, w: pixels counted
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "group_sum.glsl"
#include "view_radiance.glsl"
layout(std430, binding = BINDING_PIXEL_BATCHES) readonly buffer PixelBatchBuffer { float pixel_batches[]; };
layout(std430, binding = BINDING_STATISTICS) writeonly buffer StatisticsBuffer { vec4 partial[]; };
#include "false_colour.glsl"
uniform float logarithm_floor;   // radiance units
uniform float unsampled_error;   // relative error to assume where no batches exist yet
uniform float variance_of_mean;  // of all batches over the mean square deviation of single ones: view/error_interval.h
uniform float fresh_share;       // batches with less than this share of the weight say nothing

vec4 probe_statistics(uint probe) {
    uvec2 at = uvec2(probe % view.size.z, probe / view.size.z) * 4u + 1u;
    if (at.x >= view.size.x || at.y >= view.size.y) {
        return vec4(0.0);
    }
    uint index = at.y * view.size.x + at.x;
    PixelSurface p = load_pixel(index);
    if (p.patch_id == NO_PATCH || (p.facet & (PIXEL_EMITTER | PIXEL_UNLIT)) != 0u) {
        return vec4(0.0);
    }
    float share = 1.0;
#if defined(CONTINUED)
    // A pixel of the picture counts once: by the strongest end of its view ray.
    share = continued[index].branch == 0u ? luminance(continued[index].throughput) : 0.0;
    if (share <= 0.0) {
        return vec4(0.0);
    }
#elif defined(MIRRORS)
    if ((p.facet & PIXEL_CONTINUED) != 0u) {
        return vec4(0.0);
    }
#endif
    float l = share * luminance(pixel_radiance(index, p));
    float logarithm = log(max(l, logarithm_floor));
    float weight = pixel_weight(texelFetch(pixel_irradiance_texels, int(index)), view.weights.x);
    float batch_weight = view.weights.y;
    if (weight <= 0.0 || batch_weight <= fresh_share * weight) {
        float guess = unsampled_error * l;  // just disoccluded, or the camera has just moved
        return vec4(guess * guess, l * l, logarithm, 1.0);
    }
    float mean = 0.0;
    float square = 0.0;
    for (uint batch = 0u; batch < BATCHES; ++batch) {
        float value = pixel_batches[BATCHES * probe + batch] / batch_weight;
        mean += value;
        square += value * value;
    }
    mean /= float(BATCHES);
    float variance = max(square / float(BATCHES) - mean * mean, 0.0) * variance_of_mean;
    // The batches may be younger than the mean that is shown.
    variance *= min(float(BATCHES) * batch_weight / weight, 1.0);
    float reflectance = share * luminance(pixel_albedo(p)) * inverse_pi;
    return vec4(min(variance * reflectance * reflectance, l * l), l * l, logarithm, 1.0);
}

void main() {
    uint probes = view.size.z * view.size.w;
    vec4 sum = vec4(0.0);
    for (uint probe = gl_GlobalInvocationID.x; probe < probes; probe += gl_NumWorkGroups.x * 64u) {
        sum += probe_statistics(probe);
    }
    vec4 total = group_sum(sum);
    if (gl_LocalInvocationID.x == 0u) {
        partial[gl_WorkGroupID.x] = total;
    }
}
