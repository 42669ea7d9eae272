// SPDX-License-Identifier: Apache-2.0
// Whether pixels are seen from the point of a perspective bundle. The including shader has pixel_receiver.glsl.
#include "hemicube.glsl"
layout(binding = UNIT_SURFACE_IDS) uniform usampler2D surface_ids;
layout(binding = UNIT_DEPTHS) uniform sampler2D depths;

/// True where the shooter sees x. d: x in bundle coordinates.
bool visible(Receiver x, ivec2 texel, float depth, float r, float cos_x, vec3 d) {
    uint surface = texelFetch(surface_ids, texel, 0).r;
    float hit_depth = bundle.origin.w / texelFetch(depths, texel, 0).r;
    bool seen = surface == NO_HIT || surface == x.surface || depth <= hit_depth * 1.0001;
    WHERE(!seen) {
        int face;
        vec3 hit = hemicube_direction(sample_point(texel), float(bundle.resolution.x), face) * hit_depth;
        float footprint = 3.0 * depth / float(bundle.resolution.x) / max(cos_x, 0.02);
        vec3 towards_shooter = (bundle.origin.xyz - x.position) / r;
        seen = beside_receiver(x, surface, hit - d, towards_shooter, footprint, 2e-5 * r);
    }
    return seen;
}

/// First pixel of a face in the stacked picture.
ivec2 face_origin(int face) {
    int n = int(bundle.resolution.x);
    return ivec2(0, face == 0 ? 0 : n + (face - 1) * n / 2);
}
