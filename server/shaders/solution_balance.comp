// SPDX-License-Identifier: Apache-2.0
// Total fluxes, and the scale of the iterate that makes the global energy balance exact.
#include "layouts.glsl"
layout(local_size_x = 1) in;
layout(std430, binding = BINDING_FLUX) buffer FluxBuffer { FluxSums flux[]; };
layout(std430, binding = BINDING_BALANCE) buffer BalanceBuffer { Balance balance; };
uniform uint block_count;
uniform bool balanced;  // a sky sends flux of its own: no balance
uniform bool constant_radiance;
uniform bool shoots_only;  // nothing but perspective bundles: no line that meets nothing is ever looked at

/// Share of outgoing flux that reaches a patch: of what was shot, not of what there is to shoot, since few shots
/// are far from that.
vec3 arriving_share() {
    vec3 sent = balance.outgoing.rgb;
    vec3 k = vec3(1.0);
    for (int c = 0; c < 3; ++c) {
        k[c] = sent[c] > 0.0 ? clamp(1.0 - balance.escaped[c] / sent[c], 0.0, 1.0) : 1.0;
    }
    return k;
}

/// One-aggregate correction (as in iterative aggregation-disaggregation): the slowest mode of the
/// iteration is the overall level, which forgets its dark start like albedo^n and magnifies noise by
/// 1/(1 - albedo). But the level follows from energy conservation: with k the share of outgoing flux
/// that reaches a patch, s X = k (Phi_e + s R)  for incident flux X and reflected flux R.
/// 1 - k is what leaves the scene or meets backs, exactly 0 in a closed one. Where little arrives the
/// iteration forgets its start by itself, while what is known of k is mostly noise: the whole level would
/// follow that.
vec3 balanced_scale(FluxSums total) {
    vec3 k = arriving_share();
    vec3 scale = vec3(1.0);
    for (int c = 0; c < 3; ++c) {
        float missing = total.incident[c] - k[c] * total.reflected[c];
        if (missing > 0.0 && total.emitted[c] > 0.0 && balance.outgoing[c] > 0.0) {
            float exact = clamp(k[c] * total.emitted[c] / missing, 0.02, 50.0);
            scale[c] = pow(exact, smoothstep(0.3, 0.6, k[c]));
        }
    }
    return scale;
}

void main() {
    if (gl_GlobalInvocationID.x != 0u) {
        return;
    }
    FluxSums total = FluxSums(vec4(0.0), vec4(0.0), vec4(0.0));
    for (uint b = 0u; b < block_count; ++b) {
        total.incident += flux[b].incident;
        total.reflected += flux[b].reflected;
        total.emitted += flux[b].emitted;
    }
    // From here on the sums are those of the scaled iterate.
    bool estimated = balanced && balance.outgoing.w > 0.0;
    balance.scale = vec4(estimated ? balanced_scale(total) : vec3(1.0), 1.0);
    total.incident *= balance.scale;
    total.reflected *= balance.scale;
    flux[block_count] = total;
    // The mean of what surfaces reflect, and of what lines carry that meet nothing: emitters are few and far
    // from any constant.
    bool usable = constant_radiance &&
                  (!shoots_only || all(lessThanEqual(balance.escaped.rgb, 1e-4 * balance.outgoing.rgb)));
    vec3 mean = arriving_share() * total.reflected.rgb / (3.14159265359 * max(total.emitted.w, 1e-30));
    balance.constant = vec4(usable ? mean : vec3(0.0), 0.0);
}
