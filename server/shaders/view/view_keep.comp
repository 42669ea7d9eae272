// SPDX-License-Identifier: Apache-2.0
// A viewer's pixels keep what they have over a change apart from what comes in afterwards (`split`), so that it can
// be judged (zones/kept_light.h); or what is left of it joins the rest again.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#ifdef CONSTANT_RADIANCE
#include "facets.glsl"
#endif
#include "scene_geometry.glsl"
#include "pixel_sum.glsl"
#include "zone_level.glsl"
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
layout(binding = UNIT_PIXELS) uniform usamplerBuffer pixel_texels;
layout(std430, binding = BINDING_PIXEL_IRRADIANCE) buffer PixelIrradianceBuffer { vec4 pixel_irradiance[]; };
layout(std430, binding = BINDING_PIXEL_DELTA) buffer PixelKeptBuffer { vec4 pixel_kept[]; };
uniform bool split;

void main() {
    uint index = linear_index();
    if (index >= view.size.x * view.size.y) {
        return;
    }
    uint side = texelFetch(pixel_texels, int(2u * index)).w;
    vec4 sum = pixel_irradiance[index];
    vec3 constant = vec3(0.0);
#ifdef CONSTANT_RADIANCE
    uvec2 surface = texelFetch(pixel_texels, int(2u * index + 1u)).xw;
    constant = constant_share(surface.x, surface.y) * view.constant.rgb;
#endif
    if (!split) {
        if (side != NO_PATCH) {
            vec4 recent = vec4(sum.rgb + constant, pixel_weight(sum, view.weights.x));
            pixel_irradiance[index] = sum + believed_sum(patch_of_side(side), pixel_kept[index], recent);
        }
        pixel_kept[index] = vec4(0.0);
        return;
    }
    pixel_kept[index] = vec4(sum.rgb + constant, max(pixel_weight(sum, view.weights.x), 0.0));
    pixel_irradiance[index] = vec4(-constant, -view.weights.x);
}
