// SPDX-License-Identifier: Apache-2.0
// Total fluxes, and the constant radiance term (ch. 5.5) that follows from them.
#include "layouts.glsl"
layout(local_size_x = 1) in;
layout(std430, binding = BINDING_FLUX) buffer FluxBuffer { FluxSums flux[]; };
layout(std430, binding = BINDING_BALANCE) buffer BalanceBuffer { Balance balance; };
uniform uint block_count;
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
    flux[block_count] = total;
    // The mean of what surfaces reflect, and of what lines carry that meet nothing: emitters are few and far
    // from any constant.
    bool usable = !shoots_only ||
                  (balance.outgoing.w > 0.0 && all(lessThanEqual(balance.escaped.rgb, 1e-4 * balance.outgoing.rgb)));
    vec3 mean = arriving_share() * total.reflected.rgb / (3.14159265359 * max(total.emitted.w, 1e-30));
    balance.constant = vec4(usable ? mean : vec3(0.0), 0.0);
}
