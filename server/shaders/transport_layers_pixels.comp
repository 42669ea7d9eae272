// SPDX-License-Identifier: Apache-2.0
// Layered parallel bundle to the pixels of a viewer: the next surface that x sees along the bundle's
// direction sends its radiance;  E(x) += L(y) cos_x / d(omega).
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "density.glsl"
#include "scene_geometry.glsl"
#include "pixel_receiver.glsl"
#include "layers.glsl"
layout(binding = UNIT_RADIANCE) uniform samplerBuffer radiance_texels;
layout(std430, binding = BINDING_COUNTERS) readonly buffer CounterBuffer { Counters counters; };

/// First node that x sees, looking far (+z) or near (-z); NO_NODE: the sky. x_depth along the axis.
uint next_seen(uint node, Receiver x, bool far, float x_depth, vec2 lateral, float footprint) {
    uint seen = NO_NODE;
    float tiny = bundle.sky.w;
    vec3 looking = far ? bundle.axis_z.xyz : -bundle.axis_z.xyz;
    for (; node != NO_NODE; node = nodes[node].next) {
        float ahead = nodes[node].depth - x_depth;
        if (!far && ahead > footprint) {
            break;
        }
        uint surface = nodes[node].surface;
        if (patch_of_surface(surface) == x.patch_id ||
            beside_receiver(x, surface, vec3(lateral, ahead), looking, footprint, tiny)) {
            continue;
        }
        // Within the footprint what is in front by its plane is in front, whatever the pixel's depth.
        float slack = abs(ahead) <= footprint ? footprint : 0.0;
        if (far && ahead > -slack) {
            return node;
        }
        if (!far && ahead < slack) {
            seen = node;  // the nearest before x is the last one
        }
    }
    return seen;
}

void main() {
    uint index = gl_GlobalInvocationID.x;
    Receiver x;
    if (index >= view.size.x * view.size.y || counters.nodes > uint(nodes.length()) || !load_receiver(index, x)) {
        return;
    }
    vec3 value = vec3(0.0);
    vec3 offset = x.position - bundle.origin.xyz;
    vec3 d = vec3(dot(bundle.axis_x.xyz, offset), dot(bundle.axis_y.xyz, offset), dot(bundle.axis_z.xyz, offset));
    ivec2 texel = ivec2(d.xy / bundle.weights.z);
    ivec4 rectangle = bundle.scissor[0];
    bool inside = all(greaterThanEqual(texel, rectangle.xy)) && all(lessThan(texel, rectangle.zw));
    float along = dot(x.normal, bundle.axis_z.xyz);
    bool far = dot(x.geometric, bundle.axis_z.xyz) > 0.0;
    float cos_x = far ? along : -along;
    if (inside && cos_x > 0.0) {
        vec2 lateral = (vec2(texel) + 0.5) * bundle.weights.z - d.xy;
        float footprint = 1.5 * bundle.weights.z / max(cos_x, 0.02);
        uint pixel = uint(texel.y) * bundle.resolution.x + uint(texel.x);
        uint node = next_seen(heads[pixel], x, far, d.z, lateral, footprint);
        if (node == NO_NODE) {
            value = bundle.densities.x > 0.0 ? bundle.sky.rgb * (cos_x / bundle.densities.x) : vec3(0.0);
        } else {
            uint y = patch_on_side(nodes[node].surface, !far);
            if (y != NO_PATCH) {
                vec4 l = texelFetch(radiance_texels, int(y));
                float cos_y = abs(dot(patch_plane(patch_base + y).xyz, bundle.axis_z.xyz));
                value = l.rgb * (cos_x * cosine_over_density(abs(nodes[node].depth - d.z), cos_y, l.w));
            }
        }
    }
    receive(index, value);
}
