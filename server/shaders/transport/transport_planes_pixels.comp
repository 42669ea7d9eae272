// SPDX-License-Identifier: Apache-2.0
// Plane parallel bundle to the pixels of a viewer: where the plane lies in front of x, before anything else,
// the surface beyond the plane sends its radiance;  E(x) += L(y) cos_x / d(omega).
#include "layouts.glsl"
#include "density.glsl"
#include "scene_geometry.glsl"
#include "facets.glsl"
#include "pixel_receiver.glsl"
#include "parallel.glsl"
layout(binding = UNIT_SURFACE_IDS) uniform usampler2D surface_ids;
layout(binding = UNIT_RADIANCE) uniform samplerBuffer radiance_texels;  // along the bundle
#include "radiance_slope.glsl"

/// The line of a window pixel, and the receiver on it.
struct Line {
    vec3 point;       // in the window's plane
    vec2 lateral;     // from the receiver to the line, m
    float footprint;  // of a pixel on the receiver's surface, m
    float depth;      // of the receiver's plane, where the line meets it
    bool far;         // whether the receiver looks towards +z
};

/// Distance in front of the receiver's plane at which the line meets a surface's plane.
float distance_ahead(Line line, uint surface) {
    float along = plane_depth(facet_plane(facet_base + (surface >> 1)), line.point) - line.depth;
    return line.far ? along : -along;
}

/// True where a surface that the line meets is the receiver's own or one beside it, not in its way.
bool no_obstacle(Receiver x, Line line, uint surface, float ahead) {
    vec3 looking = line.far ? bundle.axis_z.xyz : -bundle.axis_z.xyz;
    return surface >> 1 == x.surface >> 1 ||
           abs(ahead) <= line.footprint &&
               beside_receiver(x, surface, vec3(line.lateral, ahead), looking, line.footprint, bundle.sky.w);
}

/// Whether nothing lies between the receiver and the plane; surface: the nearest one on its side.
bool plane_visible(Receiver x, Line line, uint surface) {
    if (surface == NO_HIT) {  // the line passes beside the edge of the receiver's surface
        return true;
    }
    float ahead = distance_ahead(line, surface);
    return ahead < -line.footprint || no_obstacle(x, line, surface, ahead);
}

/// Radiance over density from the surface beyond the plane, m.
vec3 incoming(Receiver x, Line line, uint surface) {
    if (surface == NO_HIT) {
        float density = sky_density(x.position, line.depth, line.far);
        found_density = density > 0.0 ? 1.0 / density : 0.0;
#ifdef MEDIUM
        density /= left_by_air_from_sky(x.position, line.far ? bundle.axis_z.xyz : -bundle.axis_z.xyz);
#endif
        return density > 0.0 ? sky_radiance(line.far) / density : vec3(0.0);
    }
    float ahead = distance_ahead(line, surface);
    if (ahead <= bundle.sky.w || no_obstacle(x, line, surface, ahead)) {
        return vec3(0.0);
    }
    Facet facet = load_facet(facet_base + (surface >> 1));
    float depth = plane_depth(facet.plane, line.point);
    vec3 weights;
    uint triangle = triangle_at(facet, line.point + depth * bundle.axis_z.xyz, weights);
    uint y = patch_of_surface(2u * triangle + side_of_surface(surface, !line.far));
    vec4 l = y != NO_PATCH ? radiance_at(y, weights) : vec4(0.0);
    found_density = cosine_over_density(ahead, abs(dot(facet.plane.xyz, bundle.axis_z.xyz)), l.w);
#ifdef MEDIUM
    l.rgb *= left_by_air(ahead);
#endif
    return (l.rgb - bundle.constant.rgb) * found_density;
}

vec3 gather(Receiver x, out vec3 w_in) {
    vec3 offset = x.position - bundle.origin.xyz;
    vec3 d = vec3(dot(bundle.axis_x.xyz, offset), dot(bundle.axis_y.xyz, offset), dot(bundle.axis_z.xyz, offset));
    ivec2 texel = clamp(ivec2(d.xy / bundle.weights.z), ivec2(0), ivec2(bundle.resolution.xy) - 1);
    float along = dot(x.normal, bundle.axis_z.xyz);
    Line line;
    line.far = dot(x.geometric, bundle.axis_z.xyz) > 0.0;
    float cos_x = line.far ? along : -along;
    line.point = window_point(uvec2(texel));
    line.lateral = (vec2(texel) + 0.5) * bundle.weights.z - d.xy;
    line.footprint = 1.5 * bundle.weights.z / max(cos_x, 0.02);
    // On the line itself the chance that the plane falls between two surfaces is exactly r/R.
    float depth = plane_depth(facet_plane(facet_base + (x.surface >> 1)), line.point);
    line.depth = clamp(depth, d.z - line.footprint, d.z + line.footprint);
    float plane_ahead = line.far ? bundle.axis_x.w - line.depth : line.depth - bundle.axis_x.w;
    w_in = line.far ? bundle.axis_z.xyz : -bundle.axis_z.xyz;
    if (cos_x <= 0.0 || plane_ahead < 0.0) {
        return vec3(0.0);
    }
    ivec2 ahead_of_plane = texel + ivec2(0, bundle.resolution.y);
    uint own_side = texelFetch(surface_ids, line.far ? texel : ahead_of_plane, 0).r;
    uint other_side = texelFetch(surface_ids, line.far ? ahead_of_plane : texel, 0).r;
    return plane_visible(x, line, own_side) ? cos_x * incoming(x, line, other_side) : vec3(0.0);
}

void main() { receive_pixels(); }
