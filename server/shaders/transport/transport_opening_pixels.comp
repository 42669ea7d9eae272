// SPDX-License-Identifier: Apache-2.0
// Bundle from a point of an opening to the sky, to the pixels of a viewer:
//   E(x) += L cos_x / d, where the point sees x; L comes from what it sees the other way.
#include "layouts.glsl"
#include "density.glsl"
#include "scene_geometry.glsl"
#include "facets.glsl"
#include "pixel_receiver.glsl"
#include "hemicube_visible.glsl"
layout(binding = UNIT_RADIANCE) uniform samplerBuffer radiance_texels;
#include "radiance_slope.glsl"
#include "opening_light.glsl"

vec3 gather(Receiver x, out vec3 w_in) {
    vec3 value = vec3(0.0);
    vec3 offset = x.position - bundle.origin.xyz;
    vec3 d = vec3(dot(bundle.axis_x.xyz, offset), dot(bundle.axis_y.xyz, offset), dot(bundle.axis_z.xyz, offset));
    float r = length(d);
    w_in = -offset / r;
    float cos_x = dot(x.normal, w_in);
    if (d.z > 1e-6 * r && cos_x > 0.0 && dot(x.geometric, offset) < -bundle.sky.w) {
        int face;
        float depth;
        vec2 pixel = hemicube_pixel(d, float(bundle.resolution.x), face, depth);
        ivec4 rectangle = bundle.scissor[face];
        ivec2 texel = face_origin(face) +
                      clamp(nearest_sample(pixel) - face_origin(face), rectangle.xy, rectangle.zw - 1);
        if (visible(x, texel, depth, r, cos_x, d)) {
            value = cos_x * light_through(texel, x.patch_id, x.position, w_in, r, found_density);
        }
    }
    return value;
}

void main() { receive_pixels(); }
