// SPDX-License-Identifier: Apache-2.0
// Levels of the zones that patches belong to, see zones/zone_levels.h and zones/kept_light.h.
layout(std430, binding = BINDING_ZONES) readonly buffer ZoneBuffer {
    ZoneLevelData zone_levels[MAX_ZONES];
    uint zones[];  // of patches
};

/// Irradiance of a patch at the level of its zone.
vec3 levelled(uint i, vec3 irradiance) {
    ZoneLevelData level = zone_levels[zones[i]];
    return max(level.scale.rgb * irradiance + level.offset.rgb, 0.0);
}

/// What is left of light that was kept over the last change at a patch. kept: rgb = sum over samples, w = their weight.
vec4 believed_sum(uint i, vec4 kept) {
    vec4 level = zone_levels[zones[i]].kept;
    float share = kept.w > level.w ? level.w / kept.w : 1.0;
    return vec4(share * level.rgb * kept.rgb, share * kept.w);
}
