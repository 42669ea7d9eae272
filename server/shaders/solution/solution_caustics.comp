// SPDX-License-Identifier: Apache-2.0
// What a new estimate of the caustics' irradiance (solution/specular/caustics.h) makes of the patches' radiance.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_RADIANCE) buffer RadianceBuffer { vec4 radiance[]; };
layout(std430, binding = BINDING_CAUSTICS) buffer CausticBuffer { vec4 caustic_radiance[]; };
layout(std430, binding = BINDING_CAUSTIC_IRRADIANCE) writeonly buffer CausticIrradianceBuffer {
    vec4 caustic_irradiance[];
};
layout(std430, binding = BINDING_CAUSTIC_FLUX) readonly buffer FluxBuffer { vec4 flux[]; };
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
#ifdef TRANSMISSION
layout(std430, binding = BINDING_TRANSMITTANCE) readonly buffer TransmittanceBuffer { vec4 transmittance[]; };
#endif
uniform uint patch_count;
uniform float flux_share;  // of one ray of lamps: 1 / number of rays, in radiance units for 1 cd/m^2
uniform vec3 scale;  // that the radiance was multiplied by since the last estimate

const float inverse_pi = 0.31830988618;

/// By lamps and by other surfaces, whose flux is in radiance units times m^2.
vec3 irradiance_of(uint i) {
    return (flux_share * flux[i].rgb + flux[patch_count + i].rgb) * patches[i].inverse_area;
}

void main() {
    uint i = linear_index();
    if (i >= patch_count) {
        return;
    }
    vec3 irradiance = irradiance_of(i);
    caustic_irradiance[i] = vec4(irradiance, 0.0);
    vec3 sent = surfaces[i].albedo.rgb * irradiance;
#ifdef TRANSMISSION
    vec4 through = transmittance[i];
    if (through.rgb != vec3(0.0)) {
        sent += through.rgb * irradiance_of(floatBitsToUint(through.w));
    }
#endif
    sent *= inverse_pi;
    radiance[i].rgb += sent - scale * caustic_radiance[i].rgb;
    caustic_radiance[i] = vec4(sent, 0.0);
}
