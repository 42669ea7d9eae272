// SPDX-License-Identifier: Apache-2.0
// What rays carry from one zone to another by the present iterate: one work group a pair of zones. Two vectors each:
// reflected flux, w = sum of the rays' squared luminance; emitted flux.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "luminance.glsl"
#include "group_sum.glsl"
layout(std430, binding = BINDING_SURFACES) readonly buffer SurfaceBuffer { PatchSurface surfaces[]; };
layout(std430, binding = BINDING_ZONE_ORDER) readonly buffer FirstRayBuffer { uint first_ray[]; };
layout(std430, binding = BINDING_ZONE_RAYS) readonly buffer RayBuffer { ZoneRay rays[]; };
layout(std430, binding = BINDING_ZONE_SUMS) writeonly buffer SumBuffer { vec4 sums[]; };
#include "patch_exitance.glsl"
uniform uint first_sum;

void main() {
    uint pair = gl_WorkGroupID.x;
    vec4 reflected = vec4(0.0);
    vec4 emitted = vec4(0.0);
    for (uint k = first_ray[pair] + gl_LocalInvocationID.x; k < first_ray[pair + 1u]; k += 64u) {
        ZoneRay ray = rays[k];
        vec3 r = ray.area * reflected_exitance(ray.from);
        vec3 e = ray.area * emitted_exitance(ray.from);
        float l = luminance(r + e);
        reflected += vec4(r, l * l);
        emitted.rgb += e;
    }
    reflected = group_sum(reflected);
    barrier();
    emitted = group_sum(emitted);
    if (gl_LocalInvocationID.x == 0u) {
        sums[first_sum + 2u * pair] = reflected;
        sums[first_sum + 2u * pair + 1u] = emitted;
    }
}
