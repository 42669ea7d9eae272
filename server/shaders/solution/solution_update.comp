// SPDX-License-Identifier: Apache-2.0
// End of an iteration (ch. 2.6, 4.4): takes the irradiance that the bundle gave to each patch into
//  * the mean irradiance E, the solution (weights grow, so that the dark transient fades), and
//  * the iterate x. It follows with a step that shrinks slower than 1/n; averaging such iterates
//    converges at the best rate whatever the albedo (Polyak, Juditsky 1992, "Acceleration of stochastic
//    approximation by averaging"), where transferring E itself would forget its dark start only like
//    n^-(1-albedo).
// What a Lambert patch sends follows x only between groups of iterations (solution_power_sum.comp). Bundles
// of one sequence avoid each other, and what one of them did would otherwise be in the light that the next
// ones transfer: products of their deviations have a negative mean, and the picture is too dark by a share
// that is proportional to the step (measured: 1.4 % after 300 iterations, now below 0.1 %).
// Of a glossy patch the iterate is the reflected main part itself, since its albedo depends on where the
// light comes from (gloss_update.glsl); there the bundles' order is random instead.
#include "layouts.glsl"
#include "rarely.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "accumulator.glsl"
#include "density.glsl"
#include "scatter.glsl"
layout(std430, binding = BINDING_IRRADIANCE) buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_SOURCE) buffer SourceBuffer { vec4 source[]; };
#include "zone_level.glsl"
layout(std430, binding = BINDING_BALANCE) buffer BalanceBuffer { Balance balance; };
uniform uint patch_count;
uniform float shooter_density;  // p_j / A_j of a perspective bundle
uniform bool scalar;    // the sums are form factors, to be multiplied by the shooter's radiance
uniform float weight;   // of this sample in the mean
uniform float iterate_age;  // samples that the iterate is worth
uniform uint scatter_kind;  // which of the sums the bundle's deviation joins, or SCATTER_NOT_MEASURED
uniform vec3 constant_irradiance;  // pi times the constant radiance term, which the bundle did not carry
#ifdef GLOSSY
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
#include "patch_source.glsl"
layout(std430, binding = BINDING_RADIANCE) buffer RadianceBuffer { vec4 radiance[]; };
#include "gloss_update.glsl"
#endif

/// Light that is not finite is dropped and counted, as in accumulate(): a mean would keep it for ever.
vec3 finite_or_none(vec3 light) {
    bool finite = dot(abs(light), vec3(1.0)) < 1e30;
    if (!finite) {
        atomicAdd(counters.non_finite, 1u);
    }
    return finite ? light : vec3(0.0);
}

/// What a perspective bundle says about the flux that no patch receives.
void note_escaped_flux() {
    vec3 shot = 3.14159265359 * (counters.shooter_radiance.rgb + bundle.constant.rgb) / shooter_density;
    float share = float(counters.escaped) * 5.9604645e-8;
    shot = finite_or_none(weight * shot);
    balance.escaped.rgb += share * shot;
    balance.outgoing += vec4(shot, weight);
    counters.escaped = 0;
}

void main() {
    uint i = linear_index();
    if (i == 0u && shooter_density > 0.0) {
        note_escaped_flux();
    }
    if (i >= patch_count || counters.overflowed != 0u) {
        return;
    }
    vec3 new_sample;
    if (scalar) {
        float received = trade_bias_for_noise(take_accumulated(i, 0u), bundle.weights.z, bundle.axis_z.w);
        new_sample = finite_or_none(counters.shooter_radiance.rgb * received);
    } else {
        new_sample = vec3(take_accumulated(i, 0u), take_accumulated(i, 1u), take_accumulated(i, 2u));
    }
    new_sample += constant_irradiance;
    vec4 mean = irradiance[i];
    RARELY(scatter_kind != SCATTER_NOT_MEASURED && mean.w > 0.0 && i % scout_stride == 0u) {
        float deviation = deviation_of(new_sample, mean.rgb);
        scatter[i / scout_stride][scatter_kind] += deviation * deviation;
    }
    mean.w += weight;
    mean.rgb += (new_sample - mean.rgb) * (weight / mean.w);
    irradiance[i] = mean;
    float younger = zone_levels[zones[i]].offset.w;
    float step = pow(max(iterate_age - younger, 0.0) + 1.0, -ITERATE_EXPONENT);
    vec4 iterate = source[i];
    iterate.rgb += (new_sample - iterate.rgb) * step;
    source[i] = iterate;
#ifdef GLOSSY
    RARELY(is_glossy(i)) {
        vec3 emitted = patch_source(i);
        radiance[i].rgb = emitted + update_gloss(i, new_sample, radiance[i].rgb - emitted, step);
    }
#endif
}
