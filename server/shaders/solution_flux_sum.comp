// SPDX-License-Identifier: Apache-2.0
// Fluxes of the iterate, summed over blocks of patches, always in the same order.
#include "layouts.glsl"
layout(local_size_x = POWER_BLOCK) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
#include "patch_source.glsl"
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
layout(std430, binding = BINDING_SOURCE) readonly buffer SourceBuffer { vec4 source[]; };
layout(std430, binding = BINDING_FLUX) writeonly buffer FluxBuffer { FluxSums flux[]; };
#ifdef TRANSMISSION
#include "transmission.glsl"
#endif
#ifdef GLOSSY
#include "rarely.glsl"
#include "gloss.glsl"
layout(std430, binding = BINDING_RADIANCE) readonly buffer RadianceBuffer { vec4 radiance[]; };
#endif
uniform uint patch_count;
shared FluxSums fluxes[POWER_BLOCK];

const float pi = 3.14159265359;

FluxSums patch_flux(uint i) {
    float area = patches[i].area;
    FluxSums f;
    f.incident = area * source[i];
    f.reflected = surfaces[i].albedo * f.incident;
#ifdef TRANSMISSION
    f.reflected.rgb += area * transmitted_exitance(i);
#endif
#ifdef GLOSSY  // whose albedo is not one number, and whose radiance is of this iterate already
    RARELY(is_glossy(i)) {
        f.reflected = (pi * area) * vec4(radiance[i].rgb - patch_source(i), 0.0);
    }
#endif
    f.emitted = area * vec4(pi * patch_source(i), 1.0);
    return f;
}

void main() {
    uint i = linear_index();
    uint lane = gl_LocalInvocationID.x;
    if (i < patch_count) {
        fluxes[lane] = patch_flux(i);
    } else {
        fluxes[lane] = FluxSums(vec4(0.0), vec4(0.0), vec4(0.0));
    }
    for (uint stride = POWER_BLOCK / 2; stride > 0u; stride /= 2u) {
        barrier();
        if (lane < stride) {
            fluxes[lane].incident += fluxes[lane + stride].incident;
            fluxes[lane].reflected += fluxes[lane + stride].reflected;
            fluxes[lane].emitted += fluxes[lane + stride].emitted;
        }
    }
    if (lane == 0u && i < patch_count) {
        flux[linear_group()] = fluxes[0];
    }
}
