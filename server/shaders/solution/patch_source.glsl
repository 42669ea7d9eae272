// SPDX-License-Identifier: Apache-2.0
// What a patch sends whatever the random iteration says: its emission and, in a scene with punctual lights
// (FIRST_SHOT), the main part of the first reflection of their light, solution_first_shot.comp; behind mirrors and glass
// (CAUSTICS) what caustics make of it, which may be negative, solution/specular/caustics.h. Needs `surfaces`.
#ifdef FIRST_SHOT
/// Per patch: irradiance by punctual lights (radiance units), then the radiance that it makes.
layout(std430, binding = BINDING_FIRST_SHOT) readonly buffer FirstShotBuffer { vec4 first_shot[]; };
#endif
#ifdef CAUSTICS
layout(std430, binding = BINDING_CAUSTICS) readonly buffer CausticBuffer { vec4 caustic_radiance[]; };
#endif

vec3 patch_source(uint i) {
    vec3 own = surfaces[i].emission.rgb;
#ifdef FIRST_SHOT
    own += first_shot[2u * i + 1u].rgb;
#endif
#ifdef CAUSTICS
    own += caustic_radiance[i].rgb;
#endif
    return own;
}
