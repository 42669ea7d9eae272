// SPDX-License-Identifier: Apache-2.0
// Partial sums over a viewer's probe pixels, in a fixed order:
//  x: estimated squared error of the shown luminance, from the scatter of its samples
//  y: squared luminance, z: logarithm of luminance, w: pixels counted
// and, as the third of these parts (view_detail.comp has the second):
//  x: by how much the iterate of the solution is brighter than its mean, as shown luminance, y: shown luminance
//  z: variance of the samples' mean were they independent
//  w: squared luminance by which pixels have become another since the last change
// and as the fourth, of the share k of what is shown that was kept over the last change:
//  x: squared (k times the difference from what has come in since), y: k squared times the latter's variance
//  z: k times the difference, with its sign, w: k squared times the luminance squared
// and as the fifth, of the deviations d of this batch of samples and e of the one before from all earlier ones, as shown
// luminance, see view/noise_modes.h:
//  x: d e, y: d squared, z: e squared
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "group_sum.glsl"
#include "view_radiance.glsl"
#include "view_scatter.glsl"
#include "view_kept.glsl"
layout(std430, binding = BINDING_STATISTICS) writeonly buffer StatisticsBuffer { vec4 partial[]; };
#include "false_colour.glsl"
layout(std430, binding = BINDING_SOURCE) readonly buffer IterateBuffer { vec4 iterate[]; };
uniform float logarithm_floor;   // radiance units
uniform float variance_of_mean;  // over that of independent samples: view/error/error_interval.h
uniform float variance_of_patches;  // of patches' means, over the squared distance of the iterate from them
uniform float batch_begin;       // weight of all samples when the last batch ended; 0: this is the first
uniform float batch_squares;     // sum of the squared weights of all batches, this one included
uniform float fresh_share;       // samples with less than this share of the weight say nothing

vec4 drift = vec4(0.0);      // of this invocation's probes
vec4 difference = vec4(0.0);
vec4 batches = vec4(0.0);

/// By how much the iterate of a patch's irradiance is ahead of its mean, as luminance of what is sent of it.
float ahead(uint id, vec3 sent_share) {
    return luminance(sent_share * (iterate[id].rgb - mean_irradiance[id].rgb)) * inverse_pi;
}

/// The same of what comes through from the other side, which is known per patch and has no samples of its own.
float ahead_behind(uint id) {
#ifdef TRANSMISSION
    vec4 through = transmittance[id];
    return through.rgb == vec3(0.0) ? 0.0 : ahead(floatBitsToUint(through.w), through.rgb);
#else
    return 0.0;
#endif
}

/// Variance of the shown luminance where some of it was kept over a change. scale: luminance for an irradiance.
float variance_with_kept(KeptShare k, float since, float l, float scale) {
    float own = 1.0 - k.share;
    float apart = k.share * scale * (k.mean - k.recent);
    difference += vec4(apart * apart, k.share * k.share * since, apart, k.share * k.share * l * l);
    float changed = scale * (k.before - mix(k.recent, k.mean, k.share));
    drift.w += changed * changed;
    return own * own * since + k.share * k.share * k.variance * l * l;
}

/// A batch of samples ends. Its deviation from all before it, beside that of the batch before, and the variance of the mean
/// were batches independent. scale: luminance for an irradiance.
void end_batch(uint probe, float scale, float l) {
    uint at = SCATTER_SUMS * probe;
    float weight = view.weights.y;
    float batch_weight = weight - batch_begin;
    if (batch_weight <= 0.0) {
        return;
    }
    float sum = pixel_scatter[at];
    float earlier = pixel_scatter[at + 3u];
    float of_batch = sum - earlier;
    float deviation = batch_begin > 0.0 ? scale * (of_batch / batch_weight - earlier / batch_begin) : 0.0;
    float last = pixel_scatter[at + 4u];
    batches.xyz += vec3(deviation * last, deviation * deviation, last * last);
    float squares = pixel_scatter[at + 5u] + of_batch * of_batch;
    float products = pixel_scatter[at + 6u] + batch_weight * of_batch;
    pixel_scatter[at + 3u] = sum;
    pixel_scatter[at + 4u] = deviation;
    pixel_scatter[at + 5u] = squares;
    pixel_scatter[at + 6u] = products;
    batches.w += min(scale * scale * variance_of(vec3(sum, squares, products), weight, batch_squares).y, l * l);
}

/// Squared error of the irradiance that is shown, P + c (S - P). independent: variance of the own mean S since the sums
/// began, were its samples independent. What noise P has is taken for common to both, and so for no part of D.
float shown_variance(uint index, PixelSurface p, float independent, float weight) {
    float own_weight = view.weights.y;
    // The sums may be younger than the mean that is shown.
    float own = independent * variance_of_mean * min(own_weight / weight, 1.0);
    float one = independent * own_weight * own_weight / max(view.weights.z, 1e-12);
    float patches = min(one * variance_share_of_patch(mean_irradiance[patch_of_side(p.side)].w), own);
    float c = confidence(index, p.side, weight);
    float light = luminance(object_space_irradiance(p, false));
    float unresolved = local_light(index).y * light * light;
    return c * c * own + (1.0 - c * c) * patches + (1.0 - c) * (1.0 - c) * unresolved;
}

vec4 probe_statistics(uint probe) {
    uvec2 at = uvec2(probe % view.size.z, probe / view.size.z) * 4u + 1u;
    if (at.x >= view.size.x || at.y >= view.size.y) {
        return vec4(0.0);
    }
    uint index = at.y * view.size.x + at.x;
    PixelSurface p = load_pixel(index);
    if (p.side == NO_PATCH || (p.facet & (PIXEL_EMITTER | PIXEL_UNLIT)) != 0u) {
        return vec4(0.0);
    }
    float share = 1.0;
#if defined(CONTINUED)
    // A pixel of the picture counts once: by the strongest end of its view ray.
    share = continued[index].branch + continued[index].added == 0u ? luminance(continued[index].throughput) : 0.0;
    if (share <= 0.0) {
        return vec4(0.0);
    }
#elif defined(MIRRORS)
    if ((p.facet & PIXEL_CONTINUED) != 0u) {
        return vec4(0.0);
    }
#endif
#ifdef IES
    if (luminaires_before(index, p).w < 1.0) {
        return vec4(0.0);  // it is exact
    }
#endif
    float l = share * luminance(pixel_radiance(index, p));
    float logarithm = log(max(l, logarithm_floor));
#ifdef AIR_BEFORE
    share *= left_before(p.position);
#endif
    float reflectance = share * luminance(pixel_albedo(p)) * inverse_pi;
    uint patch_id = patch_of_side(p.side);
    float through = share * ahead_behind(patch_id);
    drift.xy += vec2(share * ahead(patch_id, pixel_albedo(p)) + through, l);
    end_batch(probe, reflectance, l);
    vec4 own = own_sum(index, p);
    vec4 kept = texelFetch(pixel_kept_texels, int(index));
    float own_weight = view.weights.y;
    bool changed = kept.w > 0.0 && own_weight > 0.0;
    if (!changed && (own.w <= 0.0 || own_weight <= fresh_share * own.w)) {
        float guess = error_before * l;  // just disoccluded, or the camera has just moved
        return vec4(guess * guess, l * l, logarithm, 1.0);
    }
    float independent = mean_and_variance(probe, own_weight, view.weights.z).y;
    float alone = independent * reflectance * reflectance;
    drift.z += min(alone, l * l);
    float variance;
    if (changed) {
        KeptShare share_of_kept = kept_share(patch_id, kept, own);
        variance = variance_with_kept(share_of_kept, min(alone * variance_of_mean, l * l), l, reflectance);
    } else {
        variance = shown_variance(index, p, independent, own.w) * reflectance * reflectance;
    }
    variance += through * through * variance_of_patches;
#ifdef AIR_BEFORE
    float of_air = luminance(sent_by_air(index, left_before(p.position)));
    variance += of_air * of_air * relative_variance_of_air();
#endif
#ifdef MANY_LAMPS
    variance += texelFetch(pixel_first_shot_texels, int(index)).w * reflectance * reflectance;
#endif
    return vec4(min(variance, l * l), l * l, logarithm, 1.0);
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
    barrier();
    total = group_sum(drift);
    if (gl_LocalInvocationID.x == 0u) {
        partial[2u * gl_NumWorkGroups.x + gl_WorkGroupID.x] = total;
    }
    barrier();
    total = group_sum(difference);
    if (gl_LocalInvocationID.x == 0u) {
        partial[3u * gl_NumWorkGroups.x + gl_WorkGroupID.x] = total;
    }
    barrier();
    total = group_sum(batches);
    if (gl_LocalInvocationID.x == 0u) {
        partial[4u * gl_NumWorkGroups.x + gl_WorkGroupID.x] = total;
    }
}
