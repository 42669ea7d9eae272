// SPDX-License-Identifier: Apache-2.0
// Read access to the scene's geometry. DOUBLE_SIDED: some triangles carry a patch on their back.
layout(binding = UNIT_PATCHES) uniform samplerBuffer patch_texels;
#ifdef DOUBLE_SIDED
layout(std430, binding = BINDING_BACK_PATCH) readonly buffer BackPatchBuffer { uint back_patch[]; };
#endif

/// Plane of a patch: unit normal and offset, dot(normal, x) = offset. index: patch + base of the place.
vec4 patch_plane(uint index) { return texelFetch(patch_texels, int(2u * index)); }

/// x area (m^2), y its inverse, z object, w triangle (bits).
vec4 patch_attributes(uint index) { return texelFetch(patch_texels, int(2u * index + 1u)); }

/// Patch whose front is seen at a rasterised surface (2 * triangle + side), or NO_PATCH where the
/// back of a one-sided surface is seen: it blocks and absorbs.
uint patch_of_surface(uint surface) {
    uint triangle = surface >> 1;
#ifdef DOUBLE_SIDED
    return (surface & 1u) == 0u ? triangle : back_patch[triangle];
#else
    return (surface & 1u) == 0u ? triangle : NO_PATCH;
#endif
}
