// SPDX-License-Identifier: Apache-2.0
// Looks at how a pixel's own mean S differs from the patches' light P, D = S - P, and how that has changed since the last
// look, at fewer samples: the variance of a mean falls with the samples, and D_then - D_now has the variance that has gone.
// Sums over tiles of pixels, of luminances: first (D_then - D_now)^2, 1/n_then - 1/n_now, D_now^2, 1/n_now; then the number
// of pixels, P^2, the variance of single samples at the tile's probes (view_scatter.glsl), and the number of these.
#include "layouts.glsl"
layout(local_size_x = CONFIDENCE_TILE * CONFIDENCE_TILE) in;
#include "group_sum.glsl"
#include "view_radiance.glsl"
#include "view_scatter.glsl"
layout(std430, binding = BINDING_CONFIDENCE_LOOK) buffer LookBuffer { vec4 looks[]; };  // rgb: D; w: 1/n
layout(std430, binding = BINDING_CONFIDENCE_SUMS) writeonly buffer TileSumBuffer { vec4 tile_sums[]; };
uniform bool first;  // look

/// Irradiance that a Lambert surface would need to look as the pixel's own samples say.
vec3 own_irradiance(uint index, PixelSurface p, vec4 sum) {
    vec3 own = pixel_mean(sum, 0.0);
#ifdef GLOSSY
    RARELY((p.facet & PIXEL_GLOSSY) != 0u) {
        own += own_gloss(index) / max(pixel_albedo(p) * inverse_pi, 1e-4);
    }
#endif
    return own;
}

bool looked_at(PixelSurface p) {
    bool shown = p.side != NO_PATCH && (p.facet & (PIXEL_EMITTER | PIXEL_UNLIT)) == 0u;
#if defined(MIRRORS) && !defined(CONTINUED)
    shown = shown && (p.facet & PIXEL_CONTINUED) == 0u;
#endif
    return shown;
}

struct Sums {
    vec4 differences;
    vec4 light;
};

/// Variance of one sample of a probe pixel; x: of how many probes, 0 or 1.
vec2 scatter_of(uvec2 at) {
    bool probe = (at.x & 3u) == 1u && (at.y & 3u) == 1u;
    if (!probe || view.weights.y * view.weights.y <= 1.5 * view.weights.z) {
        return vec2(0.0);
    }
    uint number = (at.y >> 2) * view.size.z + (at.x >> 2);
    float of_mean = mean_and_variance(number, view.weights.y, view.weights.z).y;
    return vec2(1.0, of_mean * view.weights.y * view.weights.y / view.weights.z);
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
    vec3 patches = object_space_irradiance(p, false);
    vec3 difference = own_irradiance(index, p, sum) - patches;
    float share = 1.0 / effective_samples(sum.w);
    vec4 then = looks[index];
    looks[index] = vec4(difference, share);
    float change = luminance(then.rgb - difference);
    float now = luminance(difference);
    float light = luminance(patches);
    vec2 scatter = scatter_of(at);
    return Sums(vec4(first ? 0.0 : change * change, first ? 0.0 : max(then.w - share, 0.0), now * now, share),
                vec4(1.0, light * light, scatter.yx));
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
    vec4 light = group_sum(mine.light);
    if (gl_LocalInvocationID.x == 0u) {
        uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
        tile_sums[2u * tile] = differences;
        tile_sums[2u * tile + 1u] = light;
    }
}
