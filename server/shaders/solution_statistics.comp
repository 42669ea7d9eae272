// SPDX-License-Identifier: Apache-2.0
// Partial sums behind `settled`, in a fixed order, over patches by area: x = squared size of the
// correction since the last change (since loading: of everything), y = its squared error that is left. A mean
// E of weight w consists of what a special phase has left, of weight k and error e E, and of samples since:
//   error^2 = (k e E / w)^2 + (s E)^2 ((w - k) / w^2 - 1/w0),
// where what the mean had before the change, with the weight w0, is no part of the correction.
// And the squared irradiance (z), with the squared distance of the iterate from the mean (w): how noisy
// samples are.
#include "layouts.glsl"
layout(local_size_x = 256) in;
layout(std430, binding = BINDING_PATCHES) readonly buffer PatchBuffer { PatchGeometry patches[]; };
layout(std430, binding = BINDING_IRRADIANCE) readonly buffer IrradianceBuffer { vec4 irradiance[]; };
layout(std430, binding = BINDING_CHECKPOINT) readonly buffer CheckpointBuffer { vec4 checkpoint[]; };
layout(std430, binding = BINDING_STATISTICS) writeonly buffer StatisticsBuffer { vec4 partial[]; };
layout(std430, binding = BINDING_SOURCE) readonly buffer SourceBuffer { vec4 source[]; };
uniform uint patch_count;
uniform float relevance;         // changes below this share of the value count as noise

const float sample_deviation = 0.7;  // s: of patches, relative to the mean

shared vec4 sums[256];

void main() {
    uint lane = gl_LocalInvocationID.x;
    vec4 sum = vec4(0.0);
    uint stride = gl_NumWorkGroups.x * 256u;
    for (uint i = gl_GlobalInvocationID.x; i < patch_count; i += stride) {
        float now = dot(irradiance[i].rgb, vec3(0.2126, 0.7152, 0.0722));
        float correction = now - checkpoint[i].x;
        float weight = irradiance[i].w;
        float astray = dot(source[i].rgb, vec3(0.2126, 0.7152, 0.0722)) - now;
        sum.z += patches[i].area * now * now;
        sum.w += patches[i].area * astray * astray;
        if (weight > 0.0 && abs(correction) > relevance * max(now, checkpoint[i].x)) {
            float deviation = sample_deviation * now;
            float before = checkpoint[i].y > 0.0 ? 1.0 / checkpoint[i].y : 0.0;
            vec2 left = unpackHalf2x16(floatBitsToUint(checkpoint[i].w));
            float kept = min(left.y / weight, 1.0);
            float error = deviation * deviation * max((1.0 - kept) / weight - before, 0.0);
            error += kept * kept * left.x * left.x * now * now;
            error = min(error, correction * correction);  // not worse than having done nothing
            sum.x += patches[i].area * correction * correction;
            sum.y += patches[i].area * error;
        }
    }
    sums[lane] = sum;
    for (uint half_width = 128u; half_width > 0u; half_width /= 2u) {
        barrier();
        if (lane < half_width) {
            sums[lane] += sums[lane + half_width];
        }
    }
    if (lane == 0u) {
        partial[gl_WorkGroupID.x] = sums[0];
    }
}
