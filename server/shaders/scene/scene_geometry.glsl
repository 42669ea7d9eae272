// SPDX-License-Identifier: Apache-2.0
// Read access to the scene's geometry. DOUBLE_SIDED: some triangles have light on their back. PATCH_SETS: some patches are
// several triangles. A side is the front or the back of a triangle (scene/mesh/patch_mesh.h); it has the triangle's number where
// it is the front.
layout(binding = UNIT_PATCHES) uniform samplerBuffer patch_texels;
#ifdef DOUBLE_SIDED
layout(std430, binding = BINDING_BACK_SIDE) readonly buffer BackSideBuffer { uint back_side[]; };
#endif

/// Plane of a patch: unit normal and offset, dot(normal, x) = offset. index: patch + base of the place.
vec4 patch_plane(uint index) { return texelFetch(patch_texels, int(2u * index)); }

/// x area (m^2), y its inverse, z object, w triangle (bits).
vec4 patch_attributes(uint index) { return texelFetch(patch_texels, int(2u * index + 1u)); }

#ifdef PATCH_SETS
layout(binding = UNIT_SIDES) uniform usamplerBuffer side_texels;  // patch, triangle

uint patch_of_side(uint side) { return texelFetch(side_texels, int(side)).x; }

uint triangle_of_side(uint side) { return texelFetch(side_texels, int(side)).y; }
#else
uint patch_of_side(uint side) { return side; }

uint triangle_of_side(uint side) { return floatBitsToUint(patch_attributes(side).w); }
#endif

/// Side that is seen at a rasterised surface (2 * triangle + side), or NO_PATCH where the back of a one-sided surface is
/// seen: it blocks and absorbs.
uint side_of_triangle(uint surface) {
    uint triangle = surface >> 1;
#ifdef DOUBLE_SIDED
    return (surface & 1u) == 0u ? triangle : back_side[triangle];
#else
    return (surface & 1u) == 0u ? triangle : NO_PATCH;
#endif
}

/// The same, its patch.
uint patch_of_surface(uint surface) {
    uint side = side_of_triangle(surface);
#ifdef PATCH_SETS
    return side != NO_PATCH ? patch_of_side(side) : NO_PATCH;
#else
    return side;
#endif
}
