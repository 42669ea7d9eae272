// SPDX-License-Identifier: Apache-2.0
// Light source term of a change of surfaces or lights (ch. 7.4):  Le_new - Le, to which the first reflection of
// punctual lights belongs, and where reflection has changed what that makes of the mean irradiance,
// (a_new - a) E / pi.  Sets the radiance that normal iterations send, too.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "luminance.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_OLD_SURFACES) readonly buffer OldSurfaceBuffer { PatchSurface old_surfaces[]; };
layout(std430, binding = BINDING_RADIANCE) buffer RadianceBuffer { vec4 radiance[]; };
layout(std430, binding = BINDING_IRRADIANCE) readonly buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_SOURCE) readonly buffer SourceBuffer { vec4 source[]; };
layout(std430, binding = BINDING_CHANGED_RADIANCE) writeonly buffer ChangedBuffer { vec4 changed[]; };
layout(std430, binding = BINDING_BALANCE) buffer BalanceBuffer { Balance balance; };
layout(std430, binding = BINDING_TRIANGLES) readonly buffer TriangleBuffer { uvec4 triangles[]; };
layout(std430, binding = BINDING_PATCH_TRIANGLE) readonly buffer PatchTriangleBuffer { uint patch_triangle[]; };
#ifdef FIRST_SHOT
layout(std430, binding = BINDING_FIRST_SHOT) readonly buffer FirstShotBuffer { vec4 first_shot[]; };
layout(std430, binding = BINDING_OLD_FIRST_SHOT) readonly buffer OldFirstShotBuffer { vec4 old_first_shot[]; };
#endif
#ifdef GLOSSY
layout(std430, binding = BINDING_GLOSS) buffer GlossBuffer { uvec4 gloss[]; };
layout(std430, binding = BINDING_CHAIN) buffer ChainBuffer { vec2 chain[]; };
#endif
uniform uint patch_count;
uniform vec3 scale;     // that the solution was multiplied by
uniform uint material;  // NO_PATCH: the source term of all; else what patches of a material send, that reflects otherwise

const float remembered_samples = 16.0;
const float inverse_pi = 0.31830988618;

void main() {
    uint i = linear_index();
    if (i == 0u && material == NO_PATCH) {  // how much light escapes depends on where it is sent from
        float kept = min(1.0, remembered_samples / max(balance.outgoing.w, 1e-6));
        balance.escaped *= kept;
        balance.outgoing *= kept;
    }
    if (i >= patch_count) {
        return;
    }
    if (material == NO_PATCH) {
        vec3 emitted = surfaces[i].emission.rgb - scale * old_surfaces[i].emission.rgb;
#ifdef FIRST_SHOT
        vec3 first_change = first_shot[2u * i + 1u].rgb - scale * old_first_shot[2u * i + 1u].rgb;
        emitted += first_change;
#ifdef GLOSSY  // a sample of a lamp that has gone out would block the acceptance of others, as in solution_forget.comp
        chain[i].x *= 1.0 - clamp(luminance(abs(first_change)) / max(luminance(radiance[i].rgb), 1e-12), 0.0, 1.0);
#endif
#endif
        vec3 reflected = (surfaces[i].albedo.rgb - old_surfaces[i].albedo.rgb) * inverse_pi;
        changed[i] = vec4(emitted + reflected * irradiance[i].rgb, 0.0);
#ifdef FIRST_SHOT  // what a light that goes out has brought leaves nothing behind but rounding
        radiance[i].rgb = max(radiance[i].rgb + emitted, 0.0);
#else
        radiance[i].rgb += emitted;
#endif
    } else if ((triangles[patch_triangle[i]].w & MATERIAL_MASK) == material) {
        radiance[i].rgb = surfaces[i].emission.rgb + surfaces[i].albedo.rgb * source[i].rgb * inverse_pi;
#ifdef FIRST_SHOT
        radiance[i].rgb += first_shot[2u * i + 1u].rgb;
#endif
#ifdef GLOSSY
        // An old bright sample would block the acceptance of new ones.
        gloss[i].y = 0u;
        chain[i].x = 0.0;
#endif
    }
}
