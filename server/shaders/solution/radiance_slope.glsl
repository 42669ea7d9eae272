// SPDX-License-Identifier: Apache-2.0
// Radiance that changes within a patch. The solution knows one value for a patch, and from afar that is all that matters.
// Close by, in a corner, a groove, a slot, it is not: a surface there would get the light of the whole patch from its
// dark end (linear elements cure radiosity of that: Zatz 1993, "Galerkin Radiosity"). So what a patch sends from a point is
// its radiance and the rise of a linear function there, solution_radiance_slopes.comp, whose mean over the patch is zero: of
// all of its light it neither takes nor adds any. Requires density.glsl and, as radiance_texels, what the
// including shader's patches send.
layout(binding = UNIT_SLOPES) uniform usamplerBuffer slope_texels;

/// Change of a patch's radiance with the barycentric weights of corners 1 and 2 against that of corner 0.
struct Slope {
    vec3 along1;
    vec3 along2;
};

Slope slope_of(uint patch_id) {
    uvec4 texel = texelFetch(slope_texels, int(patch_id));
    vec2 b = unpackHalf2x16(texel.y);
    float carried = bundle.slopes.w;
    return Slope(carried * vec3(unpackHalf2x16(texel.x), b.x), carried * vec3(b.y, unpackHalf2x16(texel.z)));
}

/// Difference from the patch's mean at a point, or along a step; weights: barycentric, their sum is 1, or 0 of a step.
vec3 rise(Slope slope, vec3 weights) {
    return slope.along1 * (weights.y - weights.x) + slope.along2 * (weights.z - weights.x);
}

/// What a patch sends from a point, but for gloss; w: p_j/A_j of the patch.
vec4 radiance_at(uint patch_id, vec3 weights) {
    return texelFetch(radiance_texels, int(patch_id)) + vec4(rise(slope_of(patch_id), clamp(weights, 0.0, 1.0)), 0.0);
}
