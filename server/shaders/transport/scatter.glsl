// SPDX-License-Identifier: Apache-2.0
// Of every scout_stride-th patch: sums of the squared deviations of single samples from the mean irradiance
// (luminance, radiance units), x of parallel, y of perspective bundles.

#include "luminance.glsl"
layout(std430, binding = BINDING_SCATTER) buffer ScatterBuffer { vec2 scatter[]; };
uniform uint scout_stride;

float deviation_of(vec3 value, vec3 mean) { return luminance(value - mean); }
