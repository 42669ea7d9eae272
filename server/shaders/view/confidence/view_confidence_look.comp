// SPDX-License-Identifier: Apache-2.0
// Looks at how the own means of a picture's pixels differ from the patches' light P: D = S - P, view_confidence.glsl. Sums over
// tiles of pixels, of luminances: D^2, 1/n - 1/N, P^2 and the number of pixels; then the variance of single samples at the
// tile's probes (view_scatter.glsl), the number of these, and the sum of 1/n.
#include "layouts.glsl"
layout(local_size_x = CONFIDENCE_TILE * CONFIDENCE_TILE) in;
#include "group_sum.glsl"
#include "view_radiance.glsl"
#include "view_scatter.glsl"
layout(std430, binding = BINDING_CONFIDENCE_SUMS) writeonly buffer TileSumBuffer { vec4 tile_sums[]; };

/// Irradiance that a Lambert surface would need to look as the pixel's own samples say.
vec3 own_irradiance(uint index, PixelSurface p, vec4 sum) {
    vec3 own = pixel_mean(sum, 0.0);
#ifdef GLOSSY
    RARELY((p.facet & PIXEL_GLOSSY) != 0u) {
        vec4 gloss = texelFetch(pixel_gloss_texels, int(index));
        own += gloss.rgb / (max(pixel_weight(gloss, view.weights.x), 1e-6) * max(pixel_albedo(p) * inverse_pi, 1e-4));
    }
#endif
    return own;
}

bool looked_at(PixelSurface p) {
    bool shown = p.side != NO_PATCH && (p.facet & PIXEL_UNLIT) == 0u;  // what emits may reflect, too
#if defined(MIRRORS) && !defined(CONTINUED)
    shown = shown && (p.facet & PIXEL_CONTINUED) == 0u;
#endif
    return shown;
}

struct Sums {
    vec4 differences;
    vec4 scatter;
};

/// Variance of one sample of a probe pixel; y: of how many probes, 0 or 1.
vec2 scatter_of(uvec2 at) {
    bool probe = (at.x & 3u) == 1u && (at.y & 3u) == 1u;
    if (!probe || view.weights.y * view.weights.y <= 1.5 * view.weights.z) {
        return vec2(0.0);
    }
    uint number = (at.y >> 2) * view.size.z + (at.x >> 2);
    float of_mean = mean_and_variance(number, view.weights.y, view.weights.z).y;
    return vec2(of_mean * view.weights.y * view.weights.y / view.weights.z, 1.0);
}

Sums look(uvec2 at) {
    uint index = at.y * view.size.x + at.x;
    PixelSurface p = load_pixel(index);
    vec4 sum = vec4(0.0);
    if (looked_at(p)) {
        sum = shown_sum(index, p);
    }
    if (sum.w <= 0.0) {
        return Sums(vec4(0.0), vec4(0.0));
    }
    float light = luminance(object_space_irradiance(p, false));
    float difference = luminance(own_irradiance(index, p, sum)) - light;
    return Sums(vec4(difference * difference, patches_ahead(sum.w, p.side), light * light, 1.0),
                vec4(scatter_of(at), 1.0 / effective_samples(sum.w), 0.0));
}

void main() {
    uvec2 at = gl_WorkGroupID.xy * CONFIDENCE_TILE +
               uvec2(gl_LocalInvocationID.x % CONFIDENCE_TILE, gl_LocalInvocationID.x / CONFIDENCE_TILE);
    Sums mine = Sums(vec4(0.0), vec4(0.0));
    if (all(lessThan(at, view.size.xy))) {
        mine = look(at);
    }
    vec4 differences = group_sum(mine.differences);
    barrier();
    vec4 scatter = group_sum(mine.scatter);
    if (gl_LocalInvocationID.x == 0u) {
        uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
        tile_sums[2u * tile] = differences;
        tile_sums[2u * tile + 1u] = scatter;
    }
}
