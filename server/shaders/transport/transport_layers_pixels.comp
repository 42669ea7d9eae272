// SPDX-License-Identifier: Apache-2.0
// Layered parallel bundle to the pixels of a viewer: the next surface that x sees along the bundle's
// direction sends its radiance;  E(x) += L(y) cos_x / d(omega).
//
// A window's line runs up to a pixel of the window beside the receiver, and what is as near to that as the line, the
// line sees otherwise: light in a slot would be spread over the floor beside it. Crowded receivers (view_crowded.comp)
// follow their own ray as far as that matters. So does a receiver that no line nearby meets, before it believes in the sky.
#include "layouts.glsl"
#include "rarely.glsl"
#include "density.glsl"
#include "scene_geometry.glsl"
#include "facets.glsl"
#include "pixel_receiver.glsl"
#include "layers.glsl"
#if defined(CROWDED) || defined(SKY)
#include "facet_boxes.glsl"
#endif
#ifdef CROWDED
uniform float own_ray_reach;  // m
#endif
layout(binding = UNIT_RADIANCE) uniform samplerBuffer radiance_texels;  // along the bundle
#include "radiance_slope.glsl"
layout(std430, binding = BINDING_COUNTERS) readonly buffer CounterBuffer { Counters counters; };

/// What x sees along the axis.
struct Seen {
    uint surface;  // NO_HIT: the sky
    float ahead;   // m
    bool own;      // the line meets the receiver's own surface
    bool unsure;   // and another one as near, which it takes for one behind it
};

#ifdef CROWDED
/// Whether the receiver's own ray is followed as far as a facet's plane, or leads away from it: what it met there counts,
/// and not what the line meets beside it. Of each facet one of them decides, never both.
bool own_ray_decides(vec4 plane, Receiver x, vec3 looking) {
    float height = plane.w - dot(plane.xyz, x.position);
    float approach = dot(plane.xyz, looking);
    // height / approach < own_ray_reach
    return approach > 0.0 ? height < own_ray_reach * approach : height > own_ray_reach * approach;
}
#endif

/// Nearest surface that x sees, looking far (+z) or near (-z), among those on the window pixel's line.
/// line: in the window's plane; x_depth: of x along the axis; lateral: from x to the line.
/// CROWDED: only beyond the way that the receiver's own ray is followed.
Seen look(uint pixel, Receiver x, bool far, float x_depth, vec3 line, vec2 lateral, float footprint) {
    Seen seen = Seen(NO_HIT, beyond_all, false, false);
    float tiny = bundle.sky.w;
    vec3 looking = far ? bundle.axis_z.xyz : -bundle.axis_z.xyz;
    vec3 geometric = x.geometric * mat3(bundle.axis_x.xyz, bundle.axis_y.xyz, bundle.axis_z.xyz);
    uint count = min(layer_counts[pixel], layer_capacity());
    for (uint k = 0u; k < count; ++k) {
        uint surface = layer_surfaces[layer_slot(k, pixel)];
#ifdef SKY
        seen.own = seen.own || surface >> 1 == x.surface >> 1;
#endif
        vec4 plane = facet_plane(facet_base + facet_of(surface));
        if (is_turned_over(surface) || folded_over(surface, plane)) {
            continue;
        }
        float along = plane_depth(plane, line) - x_depth;
        float ahead = far ? along : -along;
        // Within the footprint what is in front by its plane is in front, whatever the pixel's depth.
        bool close = abs(ahead) <= footprint;
#ifdef CROWDED
        bool passed = own_ray_decides(plane, x, looking);
#else
        bool passed = surface == x.surface || ahead < (close ? -footprint : 0.0);
        WHERE(close && !passed) {
            passed = beside_receiver(x, surface, vec3(lateral, along), looking, footprint, tiny);
        }
#endif
#ifdef SKY
        seen.unsure = seen.unsure || (passed && close && surface >> 1 != x.surface >> 1);
#endif
        if (passed) {
            continue;
        }
        // Of coinciding surfaces the one that faces x is seen.
        ahead -= faces_far(surface) != far ? tiny : 0.0;
        bool nearer = ahead < seen.ahead || (ahead == seen.ahead && surface < seen.surface);
        // Behind the receiver's own surface, as the lamp in a shade is for its outside, only what goes through that
        // surface can be in front.
        RARELY(nearer && ahead <= footprint && dot(geometric, vec3(lateral, along)) < -tiny) {
            nearer = meets_facet(load_facet(facet_base + facet_of(surface)), x.position, looking);
        }
        if (nearer) {
            seen = Seen(surface, ahead, seen.own, seen.unsure);
        }
    }
    return seen;
}

/// L(y) cos_y / d(omega) of what lies `ahead`, m, of x. point: on the facet; side: of it.
vec3 sent_by(Receiver x, vec3 towards, Facet facet, vec3 point, uint side, float ahead) {
    vec3 weights;
    uint y = patch_of_surface(2u * triangle_at(facet, point, weights) + side);
    vec4 l = y != NO_PATCH ? radiance_at(y, weights) : vec4(0.0);
    float cos_y = abs(dot(facet.plane.xyz, bundle.axis_z.xyz));
    float beside = 0.0;
#if defined(SKY) && !defined(SPECIAL)
    beside = density_beside(x.patch_id, x.position, y, towards, ahead);
#endif
    found_density = cosine_over_density(ahead, cos_y, l.w, beside);
#ifdef MEDIUM
    l.rgb *= left_by_air(ahead);
#endif
    return (l.rgb - bundle.constant.rgb) * found_density;
}

vec3 gather(Receiver x, out vec3 w_in) {
    vec3 value = vec3(0.0);
    w_in = vec3(0.0);
    vec3 offset = x.position - bundle.origin.xyz;
    vec3 d = vec3(dot(bundle.axis_x.xyz, offset), dot(bundle.axis_y.xyz, offset), dot(bundle.axis_z.xyz, offset));
    ivec2 texel = ivec2(d.xy / bundle.weights.z);
    ivec4 rectangle = bundle.scissor[0];
#ifndef SPECIAL
    texel = clamp(texel, rectangle.xy, rectangle.zw - 1);
#endif
    bool inside = all(greaterThanEqual(texel, rectangle.xy)) && all(lessThan(texel, rectangle.zw));
    float along = dot(x.normal, bundle.axis_z.xyz);
    bool far = dot(x.geometric, bundle.axis_z.xyz) > 0.0;
    float cos_x = far ? along : -along;
    WHERE(inside && cos_x > 0.0) {
        vec3 line = window_point(uvec2(texel));
        vec2 lateral = (vec2(texel) + 0.5) * bundle.weights.z - d.xy;
        float footprint = 1.5 * bundle.weights.z / max(cos_x, 0.02);
        uint pixel = uint(texel.y) * bundle.resolution.x + uint(texel.x);
        w_in = far ? bundle.axis_z.xyz : -bundle.axis_z.xyz;
#ifdef CROWDED
        Met met = nearest_facet(x.position, w_in, own_ray_reach, bundle.sky.w);
        if (met.facet != NO_HIT) {
            Facet facet = load_facet(facet_base + met.facet);
            return cos_x * sent_by(x, w_in, facet, x.position + met.ahead * w_in, met.back ? 1u : 0u, met.ahead);
        }
#endif
        Seen seen = look(pixel, x, far, d.z, line, lateral, footprint);
#ifdef SKY
        // A line beside the receiver's surface may pass outside of a room. One next to it that meets the surface
        // sees what the receiver sees.
        RARELY(seen.surface == NO_HIT && !seen.own) {
            for (int k = 0; k < 9 && !seen.own; ++k) {
                ivec2 other = texel + ivec2(k % 3 - 1, k / 3 - 1);
                if (any(lessThan(other, rectangle.xy)) || any(greaterThanEqual(other, rectangle.zw))) {
                    continue;
                }
                vec3 other_line = window_point(uvec2(other));
                vec2 aside = (vec2(other) + 0.5) * bundle.weights.z - d.xy;
                uint at = uint(other.y) * bundle.resolution.x + uint(other.x);
                Seen found = look(at, x, far, d.z, other_line, aside, footprint);
                if (found.own) {
                    seen = found;
                    line = other_line;
                }
            }
        }
        // None may: facets are narrower than the window's pixels in many files. Then, and where walls meet, the receiver's own
        // ray decides. Objects that have moved are where they are now to a ray.
        Met beyond = Met(NO_HIT, 0.0, false);
        RARELY(seen.surface == NO_HIT && (seen.unsure || !seen.own) && facet_base == 0u) {
            beyond = nearest_facet(x.position, w_in, beyond_all, bundle.sky.w);
        }
        if (beyond.facet != NO_HIT) {
            vec3 point = x.position + beyond.ahead * w_in;
            return cos_x * sent_by(x, w_in, load_facet(beyond.facet), point, beyond.back ? 1u : 0u, beyond.ahead);
        }
#endif
        if (seen.surface == NO_HIT) {
            float density = sky_density(x.position, d.z, far);
            found_density = density > 0.0 ? 1.0 / density : 0.0;
            value = density > 0.0 ? sky_radiance(far) * (cos_x / density) : vec3(0.0);
#ifdef MEDIUM
            value *= left_by_air_from_sky(x.position, w_in);
#endif
        } else {
            Facet facet = load_facet(facet_base + (seen.surface >> 1));
            float depth = plane_depth(facet.plane, line);
            vec3 point = line + depth * bundle.axis_z.xyz;
            value = cos_x * sent_by(x, w_in, facet, point, side_of_surface(seen.surface, !far), abs(depth - d.z));
        }
    }
    return value;
}

void main() {
    if (counters.layers <= layer_capacity()) {
        receive_pixels();
    }
}
