// SPDX-License-Identifier: Apache-2.0
// The mean irradiance that is served: what was kept over the last change, as far as it is believed, with what has come
// in since, MERGED: by own samples and by those of other workers.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_IRRADIANCE) writeonly buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_KEPT) readonly buffer KeptBuffer { vec4 kept[]; };
layout(std430, binding = BINDING_SINCE) readonly buffer SinceBuffer { vec4 since[]; };
#ifdef MERGED
layout(std430, binding = BINDING_OTHERS) readonly buffer OthersBuffer { vec4 others[]; };
#endif
#include "zone_level.glsl"
uniform uint patch_count;

void main() {
    uint i = linear_index();
    if (i >= patch_count) {
        return;
    }
    vec4 recent = since[i];
#ifdef MERGED
    float all = recent.w + others[i].w;
    recent = vec4(all > 0.0 ? mix(recent.rgb, others[i].rgb, others[i].w / all) : recent.rgb, all);
#endif
    vec3 old_mean = zone_levels[zones[i]].kept.rgb * kept[i].rgb;
    float weight = believed_weight(i, old_mean, kept[i].w, recent.rgb, recent.w) + recent.w;
    irradiance[i] = vec4(weight > 0.0 ? old_mean + (recent.rgb - old_mean) * (recent.w / weight) : old_mean, weight);
}
