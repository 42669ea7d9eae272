// SPDX-License-Identifier: Apache-2.0
// Diffuse transmission: patches that send light which arrives on their other side. Needs `source`.
/// rgb: share of it that is sent from here; w: that patch (bits), or NO_PATCH.
layout(std430, binding = BINDING_TRANSMITTANCE) readonly buffer TransmittanceBuffer { vec4 transmittance[]; };

/// Flux per area, radiance units, that a patch sends of the iterate's irradiance on its other side.
vec3 transmitted_exitance(uint i) {
    vec4 t = transmittance[i];
    uint other = floatBitsToUint(t.w);
    return other == NO_PATCH ? vec3(0.0) : t.rgb * source[other].rgb;
}
