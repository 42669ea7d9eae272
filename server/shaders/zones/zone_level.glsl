// SPDX-License-Identifier: Apache-2.0
// Levels of the zones that patches belong to, see zones/zone_levels.h and zones/kept_light.h.
#include "luminance.glsl"
layout(std430, binding = BINDING_ZONES) readonly buffer ZoneBuffer {
    ZoneLevelData zone_levels[MAX_ZONES];
    uint zones[];  // of patches
};

/// Irradiance of a patch at the level of its zone.
vec3 levelled(uint i, vec3 irradiance) {
    ZoneLevelData level = zone_levels[zones[i]];
    return max(level.scale.rgb * irradiance + level.offset.rgb, 0.0);
}

/// Squared difference of two means of a patch's light over the variance that samples of a relative deviation of 1 give
/// it; x: nothing is known where either has no samples. mean, weight: of what was kept; then of what has come in since.
vec2 squared_difference(vec3 mean, float weight, vec3 recent, float recent_weight) {
    float together = luminance(mean * weight + recent * recent_weight) / max(weight + recent_weight, 1e-30);
    float variance = together * together * (1.0 / max(weight, 1e-30) + 1.0 / max(recent_weight, 1e-30));
    float difference = luminance(abs(mean - recent));
    return weight > 0.0 && recent_weight > 0.0 && variance > 0.0 ? vec2(1.0, difference * difference / variance) : vec2(0.0);
}

/// Samples that light kept over the last change is worth at one patch or pixel. Both means estimate the same light: what
/// their difference is beyond the noise usual in the zone is an error of the kept one.
float believed_weight(uint i, vec3 mean, float kept_weight, vec3 recent, float recent_weight) {
    const float sure = 9.0;  // three standard deviations, squared
    ZoneLevelData level = zone_levels[zones[i]];
    float weight = min(kept_weight, level.kept.w);
    float usual = level.scale.w;
    // One bright sample of few lifts a mean; nothing but many lower ones bring it down.
    const float bright_sample = 3.0;  // over the mean; 8 hides more changes, none shows sparks (five scenes)
    float together = luminance(mean * weight + recent * recent_weight) / max(weight + recent_weight, 1e-30);
    float rise = luminance(recent - mean);
    float luck = rise > 0.0 ? min(bright_sample * together / max(recent_weight, 1e-30) / rise, 1.0) : 0.0;
    vec2 q = squared_difference(mean, weight, mix(recent, mean, luck), recent_weight);
    float excess = q.y - sure * usual;
    if (excess <= 0.0) {
        return weight;
    }
    // excess * E^2 (1/w + 1/r) is the squared error; it leaves `usual` E^2 over it.
    return min(weight, usual / (excess * (1.0 / weight + 1.0 / recent_weight)));
}

/// What is left of light that was kept over the last change at a patch. kept: rgb = sum over samples, w = their weight;
/// recent: likewise of the samples since.
vec4 believed_sum(uint i, vec4 kept, vec4 recent) {
    if (kept.w <= 0.0) {
        return vec4(0.0);
    }
    vec3 mean = zone_levels[zones[i]].kept.rgb * kept.rgb / kept.w;
    float weight = believed_weight(i, mean, kept.w, recent.w > 0.0 ? recent.rgb / recent.w : vec3(0.0), recent.w);
    return vec4(mean * weight, weight);
}
