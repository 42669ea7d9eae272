// SPDX-License-Identifier: Apache-2.0
// Rays from the glossy pixels of a viewer (view/specular/gloss_rays.h). Of four consecutive pixels one has a ray in an iteration.

// trace/gloss_ray.h
struct GlossRay {
    vec3 origin;
    uint facet;
    vec3 direction;
    uint surface;
};
layout(std430, binding = BINDING_GLOSS_RAYS) buffer GlossRayBuffer { GlossRay gloss_rays[]; };
uniform uint ray_phase;   // in the first of four pixels, 0 to 3
uniform uint ray_count;

/// Pixel of the i-th ray: each of four iterations has another one of four pixels.
uint pixel_of_ray(uint i) {
    uint lane = i % GLOSS_RAYS_OF_GROUP;
    return groups[i / GLOSS_RAYS_OF_GROUP] * SPECULAR_GROUP + GLOSS_RAY_STRIDE * lane +
           (lane + ray_phase) % GLOSS_RAY_STRIDE;
}
