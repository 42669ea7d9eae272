// SPDX-License-Identifier: Apache-2.0
// What punctual lights bring has changed everywhere by a share q of all light: what patches have received since
// their light was another one counts less, as in solution_correct.comp.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_IRRADIANCE) buffer IrradianceBuffer { vec4 irradiance[]; };
#ifdef GLOSSY
layout(std430, binding = BINDING_CHAIN) buffer ChainBuffer { vec2 chain[]; };
#endif
uniform uint patch_count;
uniform float change;      // q
uniform float forgetting;  // q^2 over the weight of a special phase

void main() {
    uint i = linear_index();
    if (i < patch_count) {
        irradiance[i].w /= 1.0 + irradiance[i].w * forgetting;
#ifdef GLOSSY
        chain[i].x *= 1.0 - change;  // an old bright sample would block acceptance
#endif
    }
}
