// SPDX-License-Identifier: Apache-2.0
// Sides of the patches that are several triangles (PATCH_SETS), see solution/geometry/patch_members.h. Requires scene_geometry.glsl.
#ifdef PATCH_SETS
/// Of each patch: its first member, and the one after its last. Then members: a side, and the share of the patch's area
/// that it and those before it have (float bits).
layout(binding = UNIT_MEMBERS) uniform usamplerBuffer member_texels;

uint member_count(uint patch_id) {
    uvec2 range = texelFetch(member_texels, int(patch_id)).xy;
    return range.y - range.x;
}

float share_until(uint member) { return uintBitsToFloat(texelFetch(member_texels, int(member)).y); }

/// Side of a patch, by area. share: from [0, 1); becomes another such number, independent of the side.
uint side_within(uint patch_id, inout float share) {
    uvec2 range = texelFetch(member_texels, int(patch_id)).xy;
    uint low = range.x;
    uint high = range.y - 1u;
    while (low < high) {
        uint middle = (low + high) / 2u;
        if (share_until(middle) > share) {
            high = middle;
        } else {
            low = middle + 1u;
        }
    }
    if (range.y - range.x > 1u) {
        float before = low > range.x ? share_until(low - 1u) : 0.0;
        share = clamp((share - before) / max(share_until(low) - before, 1e-30), 0.0, 0.9999999);
    }
    return texelFetch(member_texels, int(low)).x;
}
#else
uint member_count(uint patch_id) { return 1u; }

uint side_within(uint patch_id, inout float share) { return patch_id; }
#endif
