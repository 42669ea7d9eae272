// SPDX-License-Identifier: Apache-2.0
// What patches have of many lamps becomes their first shot: irradiance, and the main part of the radiance that it makes.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "scene_geometry.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_RADIANCE) buffer RadianceBuffer { vec4 radiance[]; };
layout(std430, binding = BINDING_FIRST_SHOT) buffer FirstShotBuffer { vec4 first_shot[]; };
layout(std430, binding = BINDING_LAMP_SUMS) buffer LampSumBuffer { vec4 lamp_sums[]; };
layout(std430, binding = BINDING_LAMP_LEVELS) buffer LampLevelBuffer { vec4 lamp_levels[]; };
#ifdef TRANSMISSION
layout(std430, binding = BINDING_TRANSMITTANCE) readonly buffer TransmittanceBuffer { vec4 transmittance[]; };
#endif
uniform uint patch_count;
uniform uint pass;           // 0: irradiance; 1: what it makes; 2: the sums of a level are kept
uniform bool adds;           // the sums change what there is, but of patches on moved objects
uniform bool radiance_follows;
uniform uint level;  // of pass 2; else after the last, where what glossy patches reflect beyond their albedo is kept
uniform uvec4 moved_objects;

void main() {
    uint i = linear_index();
    if (i >= patch_count) {
        return;
    }
    vec4 attributes = patch_attributes(i);
    if (pass == 2u) {
        lamp_levels[level * patch_count + i] = lamp_sums[3u * i];
        return;
    }
    if (pass == 0u) {
        bool anew = !adds || any(equal(moved_objects, uvec4(floatBitsToUint(attributes.z))));
        vec3 sum = lamp_sums[3u * i].rgb + (anew ? lamp_sums[3u * i + 2u].rgb : vec3(0.0));
        vec3 gloss = lamp_sums[3u * i + 1u].rgb;
        vec3 light = max(anew ? sum : first_shot[2u * i].rgb + sum, 0.0);
        vec4 before = lamp_levels[level * patch_count + i];
        lamp_levels[level * patch_count + i] = vec4(gloss, 0.0) + (anew ? vec4(0.0) : before);
        first_shot[2u * i] = vec4(light, 0.0);
        return;
    }
    const float inverse_pi = 0.31830988618;
    vec3 reflected = surfaces[i].albedo.rgb * first_shot[2u * i].rgb + lamp_levels[level * patch_count + i].rgb;
#ifdef TRANSMISSION
    vec4 t = transmittance[i];
    if (t.rgb != vec3(0.0)) {
        reflected += t.rgb * first_shot[2u * floatBitsToUint(t.w)].rgb;
    }
#endif
    reflected = max(reflected * inverse_pi, 0.0);
    if (radiance_follows) {
        radiance[i].rgb = max(radiance[i].rgb + reflected - first_shot[2u * i + 1u].rgb, 0.0);
    }
    first_shot[2u * i + 1u] = vec4(reflected, attributes.x);
}
