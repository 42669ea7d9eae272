// SPDX-License-Identifier: Apache-2.0
// What single pixels show: surface point, light, and its error. One group each.
#include "layouts.glsl"
layout(local_size_x = 1) in;
#include "linear_index.glsl"
#include "view_radiance.glsl"
#include "view_scatter.glsl"
#include "view_kept.glsl"
#include "octahedral.glsl"
#include "sides.glsl"
#include "false_colour.glsl"
layout(std430, binding = BINDING_PICK) buffer PickBuffer { PickResult picks[]; };

uniform float variance_of_mean;  // as in view_statistics.comp

/// Standard error of the nearest probe pixel's samples, relative to their mean; negative where unknown.
float error_of_samples(uint pixel_index) {
    uvec2 at = uvec2(pixel_index % view.size.x, pixel_index / view.size.x) / 4u;
    // A single sample says nothing of its error.
    if (view.weights.y * view.weights.y <= 1.5 * view.weights.z) {
        return -1.0;
    }
    vec2 estimate = mean_and_variance(at.y * view.size.z + at.x, view.weights.y, view.weights.z);
    float mean = estimate.x;
#ifdef CONSTANT_RADIANCE
    mean += luminance(view.constant.rgb) / view.weights.x;
#endif
    return mean > 0.0 ? sqrt(estimate.y * variance_of_mean) / mean : -1.0;
}

/// The same of what the pixel shows: with what it has kept over a change.
float relative_error(uint pixel_index, PixelSurface p) {
    float recent = error_of_samples(pixel_index);
    vec4 kept = texelFetch(pixel_kept_texels, int(pixel_index));
    if (kept.w <= 0.0) {
        return recent;
    }
    vec4 own = own_sum(pixel_index, p);
    KeptShare k = kept_share(patch_of_side(p.side), kept, own);
    float mean = mix(k.recent, k.mean, k.share);
    vec2 errors = vec2((1.0 - k.share) * (recent < 0.0 ? 1.0 : recent) * k.recent, k.share * sqrt(k.variance) * k.mean);
    return mean > 0.0 ? length(errors) / mean : -1.0;
}

void main() {
    uint slot = linear_group();
    if (slot >= picks.length()) {
        return;
    }
    uint pixel_index = floatBitsToUint(picks[slot].position.x);
    PixelSurface p = load_pixel(pixel_index);
    if (p.side == NO_PATCH) {
        picks[slot].position = vec4(0.0);
        return;
    }
    uvec3 t = triangle_of(p.side).xyz;
    vec2 v = unpackUnorm2x16(p.barycentric);
    vec3 position = world_position(t.x) * (1.0 - v.x - v.y) + world_position(t.y) * v.x + world_position(t.z) * v.y;
    picks[slot].position = vec4(position, 1.0);
    picks[slot].normal = vec4(vector_from_octahedral(unpackSnorm2x16(p.normal)), uintBitsToFloat(object_of_triangle(t)));
    picks[slot].irradiance = vec4(blended_irradiance(pixel_index, p), uintBitsToFloat(p.side));
    picks[slot].radiance = vec4(pixel_radiance(pixel_index, p), relative_error(pixel_index, p));
}
