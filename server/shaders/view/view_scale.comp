// SPDX-License-Identifier: Apache-2.0
// Multiplies what a viewer's pixels have accumulated by a colour, see solution_scale.comp, and forgets the
// glossy part of pixels whose material reflects otherwise now. INCREMENTS: those of a special phase instead.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "facets.glsl"
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
layout(binding = UNIT_PIXELS) uniform usamplerBuffer pixel_texels;
#ifdef INCREMENTS
#define BINDING_SCALED BINDING_PIXEL_DELTA
#define BINDING_SCALED_GLOSS BINDING_PIXEL_GLOSS_DELTA
#else
#define BINDING_SCALED BINDING_PIXEL_IRRADIANCE
#define BINDING_SCALED_GLOSS BINDING_PIXEL_GLOSS
#endif
layout(std430, binding = BINDING_SCALED) buffer PixelIrradianceBuffer { vec4 pixel_irradiance[]; };
#ifdef GLOSSY
layout(std430, binding = BINDING_SCALED_GLOSS) buffer PixelGlossBuffer { vec4 pixel_gloss[]; };
#endif
uniform vec3 factor;
uniform uint material;  // that reflects otherwise, or NO_PATCH

void main() {
    uint index = linear_index();
    if (index >= view.size.x * view.size.y) {
        return;
    }
    pixel_irradiance[index].rgb *= factor;
#ifdef GLOSSY
    pixel_gloss[index].rgb *= factor;
    uint facet = texelFetch(pixel_texels, int(2u * index + 1u)).w & PIXEL_FACET_MASK;
    bool seen = texelFetch(pixel_texels, int(2u * index)).w != NO_PATCH;
    if (seen && facet_material(facet) == material) {
        pixel_gloss[index] = vec4(0.0, 0.0, 0.0, -view.weights.x);
    }
#endif
}
