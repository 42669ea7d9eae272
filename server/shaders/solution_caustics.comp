// SPDX-License-Identifier: Apache-2.0
// What a new estimate of the caustics' irradiance (solution/caustics.h) makes of the patches' radiance.
#include "layouts.glsl"
layout(local_size_x = 64) in;
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_RADIANCE) buffer RadianceBuffer { vec4 radiance[]; };
layout(std430, binding = BINDING_CAUSTICS) buffer CausticBuffer { vec4 caustic_radiance[]; };
layout(std430, binding = BINDING_CAUSTIC_IRRADIANCE) readonly buffer CausticIrradianceBuffer {
    vec4 caustic_irradiance[];
};
#ifdef TRANSMISSION
layout(std430, binding = BINDING_TRANSMITTANCE) readonly buffer TransmittanceBuffer { vec4 transmittance[]; };
#endif
uniform uint patch_count;
uniform vec3 scale;  // that the radiance was multiplied by since the last estimate

const float inverse_pi = 0.31830988618;

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= patch_count) {
        return;
    }
    vec3 sent = surfaces[i].albedo.rgb * caustic_irradiance[i].rgb;
#ifdef TRANSMISSION
    vec4 through = transmittance[i];
    if (through.rgb != vec3(0.0)) {
        sent += through.rgb * caustic_irradiance[floatBitsToUint(through.w)].rgb;
    }
#endif
    sent *= inverse_pi;
    radiance[i].rgb += sent - scale * caustic_radiance[i].rgb;
    caustic_radiance[i] = vec4(sent, 0.0);
}
