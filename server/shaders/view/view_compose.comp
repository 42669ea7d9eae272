// SPDX-License-Identifier: Apache-2.0
// Finished picture: radiance, exposure, tone curve, sRGB; row 0 at the top. Variants: LINEAR writes
// radiance as floats, of CONTINUED pixels in their own order; FALSE_LUMINANCE and FALSE_ILLUMINANCE show quantities by colour; SCALED averages
// down to a smaller frame.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "view_radiance.glsl"
#ifdef LINEAR
layout(std430, binding = BINDING_FRAME) writeonly buffer FrameBuffer { vec4 frame[]; };
#else
layout(std430, binding = BINDING_FRAME) writeonly buffer FrameBuffer { uint frame[]; };
#endif
#include "false_colour.glsl"
#include "tone_curve.glsl"
uniform uint frame_width;
uniform uint frame_height;

/// Whether a pixel shows where a plan or section cuts through something: its inside has no light.
bool cut_through(PixelSurface p) {
    return p.side == NO_PATCH && (p.facet & PIXEL_BACK) != 0u;
}

/// What is cut is hatched, at any exposure, so that it is told from dark rooms and from the sky.
vec3 hatching(uvec2 at) {
    return vec3((at.x + at.y) % 8u < 2u ? 0.62 : 0.42);
}

#if defined(FALSE_LUMINANCE) || defined(FALSE_ILLUMINANCE)
uniform float scale_begin;  // lower end of the colour scale, cd/m² or lx; 0: it is linear

/// What false colour shows of a pixel, cd/m² or lx.
float quantity(uvec2 at) {
    uint index = at.y * view.size.x + at.x;
    PixelSurface p = load_pixel(index);
#ifdef FALSE_LUMINANCE
    return luminance(pixel_radiance(index, p)) * view.display.x;
#else
#ifdef IES
    if (luminaires_before(index, p).w < 0.5) {
        return 0.0;  // of a luminaire's body it is not known
    }
#endif
    return p.side == NO_PATCH ? 0.0 : luminance(blended_irradiance(index, p)) * view.display.x;
#endif
}

/// Whether an isoline runs between two neighbours, in the unit of the isolines. Where the value jumps, as at the edge of an object,
/// there is none.
bool isoline_between(float a, float b) {
    float unit = view.display.w, top = view.display.y / unit;
    return isoline_band(a / unit, top) != isoline_band(b / unit, top) && max(a, b) < 1.5 * min(a, b);
}

/// Displayed colour of a pixel, 0..1; dark where an isoline begins.
vec3 shown(uvec2 at) {
    if (view.display.z > 0.0 && cut_through(load_pixel(at.y * view.size.x + at.x))) {
        return hatching(at);
    }
    float value = quantity(at);
    vec3 colour = false_colour(value, scale_begin, view.display.y);
    if (view.display.w > 0.0) {
        uvec2 last = view.size.xy - 1u;
        if (isoline_between(value, quantity(min(at + uvec2(1u, 0u), last))) ||
            isoline_between(value, quantity(min(at + uvec2(0u, 1u), last)))) {
            colour *= 0.15;
        }
    }
    return colour;
}
#else
/// Displayed colour of a pixel, 0..1.
vec3 shown(uvec2 at) {
    uint index = at.y * view.size.x + at.x;
    PixelSurface p = load_pixel(index);
    if (view.display.z > 0.0 && cut_through(p)) {
        return hatching(at);
    }
#ifdef UNLIT
    if ((p.facet & PIXEL_UNLIT) != 0u && p.side != NO_PATCH
#ifdef IES
        && luminaires_before(index, p).w == 1.0
#endif
    ) {
        return srgb_encoded(pixel_albedo(p));  // as it is, at any exposure
    }
#endif
    return srgb_encoded(shoulder(pixel_radiance(index, p) * view.display.y));
}
#endif

#ifdef LINEAR
/// Radiance of a pixel, in units of the display; w: 1, or share of it that shows no luminaire.
vec4 linear_radiance(uint index) {
#ifdef IES
    return radiance_and_surface_share(index, load_pixel(index)) * vec4(vec3(view.display.x), 1.0);
#else
    return vec4(pixel_radiance(index, load_pixel(index)) * view.display.x, 1.0);
#endif
}
#endif

void main() {
    uint index = linear_index();
    if (index >= frame_width * frame_height) {
        return;
    }
    uint row = index / frame_width;
    uvec2 at = uvec2(index - row * frame_width, frame_height - 1u - row);
#if defined(CONTINUED)
    frame[index] = linear_radiance(index);
#elif defined(LINEAR)
    frame[index] = linear_radiance(at.y * view.size.x + at.x);
#elif defined(SCALED)
    vec2 scale = vec2(view.size.xy) / vec2(frame_width, frame_height);
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < 4u; ++k) {
        vec2 tap = (vec2(at) + 0.25 + 0.5 * vec2(k & 1u, k >> 1)) * scale;
        sum += shown(min(uvec2(tap), view.size.xy - 1u));
    }
    frame[index] = packUnorm4x8(vec4(0.25 * sum, 1.0));
#else
    frame[index] = packUnorm4x8(vec4(shown(at), 1.0));
#endif
}
