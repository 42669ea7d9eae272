// SPDX-License-Identifier: Apache-2.0
// Perspective bundle to the pixels of a viewer:
//   E(x) += L(y) cos_x cos_y/d(y)-form, where the hemicube of y sees x.
#include "layouts.glsl"
#include "density.glsl"
#ifdef SKY
#include "sky_openings.glsl"
#endif
#include "scene_geometry.glsl"
#ifdef SHOOTER_GLOSSY
#include "sending_gloss.glsl"
#endif
#include "facets.glsl"
#include "pixel_receiver.glsl"
#include "hemicube_visible.glsl"
layout(binding = UNIT_RADIANCE) uniform samplerBuffer radiance_texels;
#include "radiance_slope.glsl"

/// Radiance of the shooter towards w_out, less the constant term.
vec3 sent_radiance(vec3 w_out) {
    vec3 sent = radiance_at(bundle.resolution.z, bundle.slopes.xyz).rgb - bundle.constant.rgb;
#ifdef SHOOTER_GLOSSY
    vec3 normal = shooter_normal();
    sent += difference_radiance(shooter_gloss(vertex_base), normal, above(w_out, normal));
#endif
    return sent;
}

vec3 gather(Receiver x, out vec3 w_in) {
    vec3 value = vec3(0.0);
    vec3 offset = x.position - bundle.origin.xyz;
    vec3 d = vec3(dot(bundle.axis_x.xyz, offset), dot(bundle.axis_y.xyz, offset), dot(bundle.axis_z.xyz, offset));
    float r = length(d);
    bool mutual = d.z > 1e-6 * r && dot(x.geometric, offset) < -bundle.sky.w;
    WHERE(mutual) {
        int face;
        float depth;
        vec2 pixel = hemicube_pixel(d, float(bundle.resolution.x), face, depth);
        ivec4 rectangle = bundle.scissor[face];
        ivec2 origin = face_origin(face);
        ivec2 texel = nearest_sample(pixel) - origin;
        bool inside = all(greaterThanEqual(texel, rectangle.xy)) && all(lessThan(texel, rectangle.zw));
#ifndef SPECIAL
        texel = clamp(texel, rectangle.xy, max(rectangle.zw - 1, rectangle.xy));
        inside = true;
#endif
        float weight = 1.0;
#ifdef SHOOTER_GLOSSY
        weight = face_weight(face);
        inside = inside && weight > 0.0;
#endif
        float cos_x = max(-dot(x.normal, offset) / r, 0.0);
        if (inside && cos_x > 0.0 && visible(x, origin + texel, depth, r, cos_x, d)) {
            float beside = 0.0;
#if defined(SKY) && !defined(SPECIAL)
            beside = density_beside(x.patch_id, x.position, bundle.resolution.z, -offset / r, r);
#endif
            found_density = cosine_over_density(r, d.z / r, bundle.densities.w, beside);
            float irradiance = weight * cos_x * found_density;
            value = sent_radiance(offset / r) * trade_bias_for_noise(irradiance, bundle.weights.z, bundle.axis_z.w);
#ifdef MEDIUM
            value *= left_by_air(r);
#endif
        }
    }
    w_in = -offset / r;
    return value;
}

void main() { receive_pixels(); }
