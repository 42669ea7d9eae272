// SPDX-License-Identifier: Apache-2.0
// The glossy part of what a patch sends through the running bundle.
#include "gloss.glsl"
#include "rarely.glsl"

/// Glossy part of a patch at the place of the objects that was drawn, whose vertices begin at vertex_base.
/// normal: of the patch, unit; middle (its centroid), point: of the patch; all at that place.
Gloss sending_gloss(uint patch_id, vec3 normal, vec3 middle, vec3 point) {
    uvec4 packed_gloss = texelFetch(gloss_texels, int(patch_id));
    LightSource source = gloss_source(packed_gloss);
    RARELY(bundle.resolution.w == 1u) {
        uint object = floatBitsToUint(patch_attributes(patch_id).z);
        for (int k = 0; k < MOST_MOVED; ++k) {
            vec3 turned = mat3(bundle.before_from_now[k]) * source.direction;
            source.direction = object == bundle.moved[k] ? turned : source.direction;
        }
    }
    Gloss g;
    g.scale = gloss_scale(packed_gloss);
    g.w_in = direction_to(source, middle, point);
    g.brdf = patch_brdf(patch_id);
    g.at_in = brdf_at(g.brdf, dot(normal, g.w_in));
    return g;
}

uvec3 triangle_of_patch(uint patch_id) { return load_triangle(floatBitsToUint(patch_attributes(patch_id).w)).xyz; }

/// Normal that the gloss of a perspective bundle's shooter is about: of its patch at the place that was drawn, not of the
/// triangle that it stands on, since through parallel bundles all of a patch sends alike.
vec3 shooter_normal() {
#ifdef PATCH_SETS
    uint patches_per_place = uint(textureSize(patch_texels)) / 4u;
    return patch_plane(bundle.resolution.z + bundle.resolution.w * patches_per_place).xyz;
#else
    return bundle.axis_z.xyz;
#endif
}

/// That of both ends of a line which is above the patch, as through parallel bundles.
vec3 above(vec3 w_out, vec3 normal) {
#ifdef PATCH_SETS
    return dot(w_out, normal) < 0.0 ? -w_out : w_out;
#else
    return w_out;
#endif
}

/// Of the shooter of a perspective bundle, at its shooting point.
Gloss shooter_gloss(uint vertex_base) {
    uint shooter = bundle.resolution.z;
    return sending_gloss(shooter, shooter_normal(), centroid_of(triangle_of_patch(shooter), vertex_base),
                         bundle.origin.xyz);
}
