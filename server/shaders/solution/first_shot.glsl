// SPDX-License-Identifier: Apache-2.0
// Light of punctual lights at a point (incoming first shot, ch. 4.3.1). Each light keeps a map of the nearest
// surfaces round it. The surfaces in the map about a point are only candidates: whether one is in the way is
// decided by its own triangle, so that the edges of shadows are as sharp as the geometry and not the map's. SHADOW_RAYS:
// where the map marks that a surface begins or ends nearby, which it may have missed, a ray decides.
#include "facets.glsl"
#ifdef MEDIUM
#include "air.glsl"
#endif
layout(std430, binding = BINDING_PUNCTUAL) readonly buffer PunctualBuffer { PunctualData punctual[]; };
layout(binding = UNIT_SHADOW_MAPS) uniform usampler2DArray shadow_maps;
#ifdef SHADOW_RAYS
layout(binding = UNIT_SHADOW_EDGES) uniform usampler2DArray shadow_edges;
#include "shadow_rays.glsl"
#elif defined(ALPHA_MASK)
layout(binding = UNIT_MATERIALS) uniform samplerBuffer material_texels;
#endif
#ifdef IES
#include "ies_profile.glsl"
#endif
uniform uint punctual_count;
uniform float shadow_tie;  // m: surfaces closer to a point than this are its own

/// Face of a cube map, and coordinates on it in [-1, 1]; the same table as face_axes() in
/// solution/direct/shadow_maps.cpp.
vec2 cube_face(vec3 d, out uint face) {
    vec3 a = abs(d);
    uint axis = a.x >= a.y && a.x >= a.z ? 0u : a.y >= a.z ? 1u : 2u;
    vec3 turned = axis == 0u ? d : axis == 1u ? d.yzx : d.zxy;
    face = 2u * axis + (turned.x < 0.0 ? 1u : 0u);
    return vec2(-sign(turned.x) * turned.y, turned.z) / abs(turned.x);
}

/// Layer of the light's map that shows the direction to a point, and the place on it in texels.
uint map_layer(PunctualData light, vec3 position, out vec2 at) {
    vec3 d = position - light.position.xyz;
    uint face = 0u;
    if (light.map.y == 6u) {
        at = cube_face(d, face);
    } else {
        at = vec2(dot(light.axis_x.xyz, d), dot(light.axis_y.xyz, d)) / light.position.w;
        at /= light.map.z == PUNCTUAL_DIRECTIONAL ? 1.0 : max(-dot(light.axis_z.xyz, d), 1e-20);
    }
    at = (at * 0.5 + 0.5) * float(light.map.w);
    return light.map.x + face;
}

/// Whether a change may reach what light k's map says about a point: cheap, and true where is_touched() is.
bool may_be_touched(uint k, vec3 position) {
    vec4 cone = punctual[k].touched_cone;
    vec3 d = position - punctual[k].position.xyz;
    return dot(cone.xyz, d) >= cone.w * length(d);
}

/// Whether a change reaches it.
bool is_touched(uint k, vec3 position) {
    vec2 at;
    uint layer = map_layer(punctual[k], position, at) - punctual[k].map.x;
    uvec4 pair = punctual[k].touched[layer >> 1];
    uvec2 texels = (layer & 1u) == 0u ? pair.xy : pair.zw;
    ivec2 first = ivec2(texels.x & 0xffffu, texels.x >> 16);
    ivec2 last = ivec2(texels.y & 0xffffu, texels.y >> 16);
    ivec2 corner = ivec2(floor(at - 0.5));
    ivec2 end = ivec2(punctual[k].map.w) - 1;
    return all(lessThanEqual(clamp(corner, ivec2(0), end), last)) &&
           all(greaterThanEqual(clamp(corner + 1, ivec2(0), end), first));
}

/// How a surface of the map stands to a line: 0 not in the way, 1 beside it, 2 in the way.
/// to_light: from the point; its length is the distance, or without limit where `distant`.
uint obstacle(uint surface, vec3 position, vec3 to_light, bool distant, uint own_facet) {
    uint index = surface >> 1;
    if (surface == NO_HIT || index == own_facet) {
        return 0u;
    }
    Facet facet = load_facet(index);
    float height = dot(facet.plane.xyz, position) - facet.plane.w;
    float rise = dot(facet.plane.xyz, to_light);
    if (abs(height) <= shadow_tie || height * rise >= 0.0 || (!distant && abs(rise) <= abs(height))) {
        return 0u;
    }
#ifdef ALPHA_MASK
    if (texelFetch(material_texels, 5 * int(facet_material(index))).w > 0.0) {
        return 1u;  // only the map knows where it is cut
    }
#endif
    vec4 meeting = vec4(position - to_light * (height / rise), 1.0);
    float w1 = dot(facet.weight1, meeting);
    float w2 = dot(facet.weight2, meeting);
    const float rim = 1e-5;
    return min(min(w1, w2), 1.0 - w1 - w2) >= -rim ? 2u : 1u;
}

/// Whether the light reaches a point of a facet. One of the four surfaces in the map about the line that is met
/// hides it. Where there is no ray, so do four that are all in front of the point and barely missed.
bool is_lit(PunctualData light, vec3 position, vec3 to_light, uint own_facet) {
    vec2 at;
    int layer = int(map_layer(light, position, at));
    ivec2 corner = ivec2(floor(at - 0.5));
    int last = int(light.map.w) - 1;
    bool distant = light.map.z == PUNCTUAL_DIRECTIONAL;
    uint beside = 0u;
#ifdef SHADOW_RAYS
    bool unsure = any(lessThan(corner, ivec2(0))) || any(greaterThanEqual(corner, ivec2(last)));
#endif
    for (int k = 0; k < 4; ++k) {
        ivec2 texel = clamp(corner + ivec2(k & 1, k >> 1), ivec2(0), ivec2(last));
        uint found = obstacle(texelFetch(shadow_maps, ivec3(texel, layer), 0).r, position, to_light, distant, own_facet);
        if (found == 2u) {
            return false;
        }
        beside += found;
#ifdef SHADOW_RAYS
        unsure = unsure || texelFetch(shadow_edges, ivec3(texel, layer), 0).r != 0u;
#endif
    }
    bool lit = beside < 4u;
#ifdef SHADOW_RAYS
    RARELY(unsure) {
        lit = !is_hidden(position, to_light, distant, own_facet, shadow_tie);
    }
#endif
    return lit;
}

#ifdef IES
/// Luminous intensity, cd, of a profile towards a unit direction away from the light.
float profile_candela(PunctualData light, vec3 direction) {
    vec3 d = vec3(dot(light.axis_x.xyz, direction), dot(light.axis_y.xyz, direction), dot(light.axis_z.xyz, direction));
    return ies_intensity(light.profile.x, d);
}
#endif

/// Illuminance (radiance units) of a surface that faces light k at a point, without obstacles. to_light: as for
/// is_lit(), from the point.
vec3 facing_illuminance(PunctualData light, vec3 position, out vec3 to_light) {
    to_light = light.axis_z.xyz;
#ifdef MEDIUM
    if (light.map.z == PUNCTUAL_DIRECTIONAL) {
        return light.intensity.rgb * left_by_air_from_sky(position, to_light);
    }
    light.intensity.rgb *= left_by_air_between(position, light.position.xyz);
#else
    if (light.map.z == PUNCTUAL_DIRECTIONAL) {
        return light.intensity.rgb;
    }
#endif
    to_light = light.position.xyz - position;
    float square = max(dot(to_light, to_light), 1e-20);
    float share = 1.0;
    if (light.map.z == PUNCTUAL_SPOT) {
        float cosine = dot(light.axis_z.xyz, to_light) * inversesqrt(square);
        share = clamp((cosine - light.axis_y.w) / (light.axis_x.w - light.axis_y.w), 0.0, 1.0);
    }
#ifdef IES
    if (light.profile.x != NO_PROFILE) {
        return light.intensity.rgb * (profile_candela(light, -to_light * inversesqrt(square)) / square);
    }
#endif
    return light.intensity.rgb * (share * share / square);
}

#ifdef IES
#include "opening.glsl"
#endif

/// Irradiance (radiance units) of a surface of this normal by a light at a point, without obstacles. to_light: to
/// where shadows are cast from; w_in: the same, of length 1.
vec3 unhindered_irradiance(PunctualData light, vec3 position, vec3 normal, out vec3 to_light, out vec3 w_in) {
#ifdef IES
    if (light.profile.z != OPENING_POINT) {
        to_light = light.position.xyz - position;
        w_in = normalize(to_light);
        return dot(normal, w_in) > 0.0 ? opening_irradiance(light, position, normal) : vec3(0.0);
    }
#endif
    vec3 arriving = facing_illuminance(light, position, to_light);
    w_in = normalize(to_light);
    return arriving * max(dot(normal, w_in), 0.0);
}

/// Irradiance (radiance units) of a point of a facet by light k; w_in: unit direction that it comes from.
/// normal: whose cosine counts; geometric: of the facet's lit side.
vec3 punctual_irradiance(uint k, vec3 position, vec3 normal, vec3 geometric, uint own_facet, out vec3 w_in) {
    PunctualData light = punctual[k];
    vec3 to_light;
    vec3 arriving = unhindered_irradiance(light, position, normal, to_light, w_in);
    bool faces = dot(normal, w_in) > 0.0 && dot(geometric, w_in) > 0.0 && arriving != vec3(0.0);
    if (!faces || !is_lit(light, position, to_light, own_facet)) {
        return vec3(0.0);
    }
    return arriving;
}
