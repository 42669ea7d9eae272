// SPDX-License-Identifier: Apache-2.0
// A viewer's pixels get what the bundles of the start could not carry, as patches do: solution_complete.comp.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "scene_geometry.glsl"
#include "pixel_sum.glsl"
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
layout(binding = UNIT_PIXELS) uniform usamplerBuffer pixel_texels;
layout(std430, binding = BINDING_PIXEL_IRRADIANCE) buffer PixelIrradianceBuffer { vec4 pixel_irradiance[]; };
layout(std430, binding = BINDING_COMPLETION) readonly buffer CompletionBuffer { vec4 completion[]; };

void main() {
    uint index = linear_index();
    if (index >= view.size.x * view.size.y) {
        return;
    }
    uint side = texelFetch(pixel_texels, int(2u * index)).w;
    float weight = pixel_weight(pixel_irradiance[index], view.weights.x);
    if (side != NO_PATCH && weight > 0.0) {
        pixel_irradiance[index].rgb += weight * completion[patch_of_side(side)].rgb;
    }
}
