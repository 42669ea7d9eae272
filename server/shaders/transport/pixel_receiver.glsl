// SPDX-License-Identifier: Apache-2.0
// Pixels of a viewer as receivers of a bundle (design: the image estimate M L of ch. 2.6 evaluated per
// pixel): each looks its surface point up in the bundle, as in a shadow map.
// The including shader says what a point receives, gather(), and its main() calls receive_pixels().
#include "luminance.glsl"
#include "octahedral.glsl"
#include "rarely.glsl"
// Few pixels meet these conditions in a phase after a change, most in other bundles.
#ifdef SPECIAL
#define WHERE(condition) RARELY(condition)
#else
#define WHERE(condition) if (condition)
#endif
layout(std140, binding = BINDING_VIEW) uniform ViewBlock { ViewParameters view; };
layout(binding = UNIT_PIXELS) uniform usamplerBuffer pixel_texels;
layout(std430, binding = BINDING_PIXEL_IRRADIANCE) buffer PixelIrradianceBuffer {
    vec4 pixel_irradiance[];
};
layout(std430, binding = BINDING_PIXEL_DELTA) buffer PixelDeltaBuffer { vec4 pixel_delta[]; };
layout(std430, binding = BINDING_PIXEL_SCATTER) buffer PixelScatterBuffer { float pixel_scatter[]; };
#if defined(SPECIAL) || defined(CROWDED)
#include "mesh.glsl"
#endif
// A layered bundle has a program for the crowded pixels (CROWDED) and one for all others (BUT_CROWDED).
#ifdef CROWDED
#define CROWDED_ACCESS readonly
#include "crowded_pixels.glsl"
#endif
#ifdef SPECIAL
#define TILE_LISTS (2 * MOST_DIFFERENCES)  // of view_affected_tiles.comp
#define TILES_ACCESS readonly
#include "tiles.glsl"
uniform bool listed_tiles;  // else all of them
uniform uint tile_list;
#endif
// In a phase after a change time is short, and what its few bundles say of neighbouring pixels is hardly ever different:
// of 2 x 2 pixels, a quad, one looks up what all that show the same surface get, another one for each bundle. Pixels
// behind a mirror have no neighbours.
#if defined(SPECIAL) && !defined(GLOSSY_PIXELS) && !defined(CONTINUED)
#define QUADS
layout(local_size_x = VIEW_TILE * VIEW_TILE / 4) in;
uniform uint first_of_quad;  // which of the four is asked first, the same before and after a move
#else
layout(local_size_x = VIEW_TILE * VIEW_TILE) in;
#endif
#include "linear_index.glsl"
#ifdef CONTINUED
#include "continued.glsl"
#endif
// In a GLOSSY scene there are two programs: one for the other pixels, one for the glossy ones (GLOSSY_PIXELS).
#ifdef GLOSSY_PIXELS
#include "pixel_gloss.glsl"
#define SPECULAR_GROUPS_ACCESS readonly
#include "specular_groups.glsl"
layout(std430, binding = BINDING_PIXEL_GLOSS) buffer PixelGlossBuffer { vec4 pixel_gloss[]; };
layout(std430, binding = BINDING_PIXEL_GLOSS_DELTA) buffer PixelGlossDeltaBuffer { vec4 pixel_gloss_delta[]; };
#if defined(GLOSS_RAYS) && !defined(SPECIAL)
#define BESIDE_RAYS
#include "lobe_sampling.glsl"
uniform float ray_share;  // rays of a pixel's lobe for each sample, in the mean; see view_gloss_rays.comp
#endif
#endif
float found_density = 0.0;  // inverse of d(omega) where gather() found light, sr
uniform uint facet_base;    // facets and vertices of the place that was drawn
uniform uint vertex_base;
uniform uvec4 moved_objects;  // that are elsewhere at place 1, the rest NO_PATCH

struct Receiver {
    vec3 position;
    vec3 normal;     // shading
    vec3 geometric;  // of the facet, on the receiving side
    uint surface;    // the facet and its receiving side
    uint object;     // SPECIAL only
    uint albedo;     // of PixelSurface; GLOSSY_PIXELS only
    uint patch_id;
};

/// Whether a pixel is one for this program. facet: with its flags.
bool receives(uint side, uint facet) {
    bool received = side != NO_PATCH;
#ifdef MIRRORS
    received = received && (facet & PIXEL_CONTINUED) == 0u;
#endif
#ifdef CROWDED
    received = received && (facet & PIXEL_CROWDED) != 0u;
#elif defined(BUT_CROWDED)
    received = received && (facet & PIXEL_CROWDED) == 0u;
#endif
#ifdef GLOSSY_PIXELS
    return received && (facet & PIXEL_GLOSSY) != 0u;
#elif defined(GLOSSY)
    return received && (facet & PIXEL_GLOSSY) == 0u;
#else
    return received;
#endif
}

/// The pixel's surface point at the place that was drawn. False where it is not for this program.
bool load_receiver(uint index, out Receiver x) {
    uvec4 p = texelFetch(pixel_texels, int(2u * index));       // position, side
    uvec4 q = texelFetch(pixel_texels, int(2u * index + 1u));  // normal, albedo, barycentric, object
    uint facet = p.w == NO_PATCH ? 0u : q.w & PIXEL_FACET_MASK;
    x.position = uintBitsToFloat(p.xyz);
    x.normal = vector_from_octahedral(unpackSnorm2x16(q.x));
    x.geometric = facet_plane(facet_base + facet).xyz;
    bool back = false;
#ifdef DOUBLE_SIDED
    back = (q.w & PIXEL_BACK) != 0u;
    x.geometric = back ? -x.geometric : x.geometric;
#endif
    x.surface = 2u * facet + (back ? 1u : 0u);
    x.object = 0u;
#ifdef CROWDED
    // Its own rays need no distance from creases, see receiving_point() of view_resolve.comp.
    vec2 v = unpackUnorm2x16(q.z);
    uvec4 t = p.w == NO_PATCH ? uvec4(0u) : load_triangle(triangle_of_side(p.w));
    x.position = world_position(t.x) * (1.0 - v.x - v.y) + world_position(t.y) * v.x + world_position(t.z) * v.y;
#endif
    x.albedo = q.y;
    x.patch_id = p.w == NO_PATCH ? NO_PATCH : patch_of_side(p.w);
#ifdef SPECIAL
    // SPECIAL: signed increments instead of samples of the mean, at either place of moved objects.
    x.object = facet_object(facet_base + facet);
    bool before = vertex_base != 0u && any(equal(uvec4(x.object), moved_objects)) && p.w != NO_PATCH;
    WHERE(before) {
        vec2 v = unpackUnorm2x16(q.z);
        uvec3 t = load_triangle(triangle_of_side(p.w)).xyz + vertex_base;
        x.position = world_position(t.x) * (1.0 - v.x - v.y) + world_position(t.y) * v.x + world_position(t.z) * v.y;
        x.normal = x.geometric;
    }
#endif
    return receives(p.w, q.w);
}

/// A bundle pixel shows the surface at its centre, up to a pixel's footprint beside the receiver's own
/// line. Such a near hit counts as what it is for the receiver's line: its plane. ahead: direction
/// (unit) in which the receiver looks; hit_offset: from receiver to hit. True where the hit lies within
/// the footprint and its plane is not in front of the receiver: then it is the receiver's own surface or
/// one beside it, not in the way.
bool beside_receiver(Receiver x, uint surface, vec3 hit_offset, vec3 ahead, float footprint, float tiny) {
    uint facet = facet_base + (surface >> 1);
    vec4 plane = facet_plane(facet);
    float height = dot(plane.xyz, x.position) - plane.w;  // of the receiver over the plane
    float approach = dot(plane.xyz, ahead);
    // Neighbouring facets of a curved object are no obstacle to each other.
    bool curved = dot(plane.xyz, x.geometric) > 0.5 && facet_object(facet) == facet_object(facet_base + (x.surface >> 1));
    float allowed = curved ? 0.5 * footprint : tiny;
    bool in_front = abs(height) > allowed && height * approach < 0.0;
    return !in_front && dot(hit_offset, hit_offset) <= footprint * footprint;
}

#ifdef GLOSSY_PIXELS
/// Adds to the glossy part what a sample of irradiance brings. Returns the irradiance that a surface without
/// gloss would need to look the same.
vec3 receive_gloss(uint index, Receiver x, vec3 w_in, vec3 value) {
    vec3 albedo = unpack_albedo(x.albedo);
#ifdef CONTINUED
    vec3 w_out = continued_towards(index);
#else
    vec3 w_out = normalize(view.eye.xyz - x.position);
#endif
    float cos_out = dot(x.normal, w_out);
    vec4 at_out;
    uint record = reflectance_record(facet_material(facet_base + (x.surface >> 1)), x.albedo);
    Brdf brdf = pixel_brdf(record, albedo, cos_out, at_out);
    vec4 at_in = brdf_at(brdf, dot(x.normal, w_in));
    vec3 reflected = value * brdf_value(brdf, x.normal, w_in, w_out, at_in.z * at_out.z);
    vec3 lambert = value * albedo * brdf_inverse_pi;
#ifdef BESIDE_RAYS
    reflected /= 1.0 + ray_share * found_density * drawn_density(drawn_lobes(brdf), x.normal, w_in, w_out);
#endif
    vec3 gloss = reflected - lambert;
#ifdef SPECIAL
    pixel_gloss_delta[index].rgb += gloss * bundle.weights.x;
#else
    pixel_gloss[index].rgb += gloss * bundle.weights.y;
#endif
    return reflected / max(albedo * brdf_inverse_pi, 1e-4);
}
#endif

/// What x receives through the bundle, irradiance in radiance units, and where it comes from (unit).
vec3 gather(Receiver x, out vec3 w_in);

#ifdef QUADS
uint pixel_of_quad(uvec2 corner, uint k) { return (corner.y + (k >> 1)) * view.size.x + corner.x + (k & 1u); }

/// Shading normal, and facet with those of its flags that tell surfaces apart; NO_PATCH as facet where nothing is
/// received.
uvec2 surface_of_pixel(uint index) {
    uint side = texelFetch(pixel_texels, int(2u * index)).w;
    uvec2 surface = texelFetch(pixel_texels, int(2u * index + 1u)).xw;
    return receives(side, surface.y) ? uvec2(surface.x, surface.y & ~PIXEL_CROWDED) : uvec2(NO_PATCH);
}

bool alike(uvec2 a, uvec2 b) {
    vec2 turned = abs(unpackSnorm2x16(a.x) - unpackSnorm2x16(b.x));
    return a.y == b.y && max(turned.x, turned.y) < 0.03;
}

void receive_pixels() {
    uvec2 corner = tile_pixel(tile_of_group(listed_tiles, tile_list), 0u) +
                   2u * uvec2(gl_LocalInvocationID.x % (VIEW_TILE / 2u), gl_LocalInvocationID.x / (VIEW_TILE / 2u));
    uvec2 surfaces[4];
    uint left = 0u;  // pixels, a bit each
    for (uint k = 0u; k < 4u; ++k) {
        bool inside = all(lessThan(corner + uvec2(k & 1u, k >> 1), view.size.xy));
        surfaces[k] = surface_of_pixel(inside ? pixel_of_quad(corner, k) : 0u);
        left |= inside && surfaces[k].y != NO_PATCH ? 1u << k : 0u;
    }
    while (left != 0u) {
        uint k = (uint(findLSB((left | left << 4) >> first_of_quad)) + first_of_quad) & 3u;
        uint index = pixel_of_quad(corner, k);
        uvec2 surface = surface_of_pixel(index);
        Receiver x;
        load_receiver(index, x);
        vec3 w_in;
        vec3 value = gather(x, w_in) * bundle.weights.x;
        bool something = value.r + value.g + value.b < 1e30 && value != vec3(0.0);
        for (uint j = 0u; j < 4u; ++j) {
            uint bit = alike(surfaces[j], surface) ? left & 1u << j : 0u;
            WHERE(something && bit != 0u) {
                pixel_delta[pixel_of_quad(corner, j)].rgb += value;
            }
            left ^= bit;
        }
    }
}
#else
/// Pixel of this invocation, or one beyond the picture.
uint receiving_pixel() {
#ifdef SPECIAL
#ifdef GLOSSY_PIXELS
    if (!listed_tiles) {
        return specular_pixel();
    }
#endif
    uvec2 at = tile_pixel(tile_of_group(listed_tiles, tile_list), gl_LocalInvocationID.x);
    return all(lessThan(at, view.size.xy)) ? at.y * view.size.x + at.x : 0xffffffffu;
#elif defined(CROWDED)
    uint k = (gl_WorkGroupID.y * crowded_groups_a_row + gl_WorkGroupID.x) * CROWDED_GROUP + gl_LocalInvocationID.x;
    return k < crowded_count ? crowded_pixels[k] : 0xffffffffu;
#elif defined(GLOSSY_PIXELS)
    return specular_pixel();
#else
    return linear_index();
#endif
}

/// What the pixel's ray has brought in this sample.
float taken_of_ray(uint probe) {
    float brought = 0.0;
#ifdef BESIDE_RAYS
    brought = pixel_scatter[SCATTER_SUMS * probe + SCATTER_OF_RAY];
    pixel_scatter[SCATTER_SUMS * probe + SCATTER_OF_RAY] = 0.0;
#endif
    return brought;
}

void note_scatter(uint probe, float sum) {
    pixel_scatter[SCATTER_SUMS * probe] += sum;
    pixel_scatter[SCATTER_SUMS * probe + 1u] += sum * sum;
    pixel_scatter[SCATTER_SUMS * probe + 2u] += bundle.weights.y * sum;
}

#ifdef BESIDE_RAYS
/// A sample of which the bundle has brought nothing.
void receive_ray_alone(uint index) {
    uvec2 at = uvec2(index % view.size.x, index / view.size.x);
    if ((at.x & 3u) == 1u && (at.y & 3u) == 1u) {
        uint probe = (at.y >> 2) * view.size.z + (at.x >> 2);
        note_scatter(probe, bundle.weights.y * taken_of_ray(probe));
    }
}
#endif

/// Adds one sample (irradiance, radiance units; from w_in) of the running bundle.
void receive(uint index, Receiver x, vec3 w_in, vec3 value) {
    bool something = value.r + value.g + value.b < 1e30 && value != vec3(0.0);
    WHERE(something) {
        vec3 seen = value;
#ifdef GLOSSY_PIXELS
        seen = receive_gloss(index, x, w_in, value);
#endif
#ifdef SPECIAL
        pixel_delta[index].rgb += value * bundle.weights.x;
#else
        float w = bundle.weights.y;
        pixel_irradiance[index].rgb += w * value;
        // One pixel in 16 sums squares, too, for the error estimate.
        uvec2 at = uvec2(index % view.size.x, index / view.size.x);
        if ((at.x & 3u) == 1u && (at.y & 3u) == 1u) {
            uint probe = (at.y >> 2) * view.size.z + (at.x >> 2);
            note_scatter(probe, w * (luminance(seen) + taken_of_ray(probe)));
        }
#endif
    }
}

void receive_pixels() {
    uint index = receiving_pixel();
    Receiver x;
    if (index >= view.size.x * view.size.y || !load_receiver(index, x)) {
        return;
    }
    vec3 w_in;
    found_density = 0.0;
    vec3 value = gather(x, w_in);
    receive(index, x, w_in, value);
#ifdef BESIDE_RAYS
    if (value == vec3(0.0)) {
        receive_ray_alone(index);
    }
#endif
}
#endif
