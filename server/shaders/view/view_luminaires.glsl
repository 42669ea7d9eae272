// SPDX-License-Identifier: Apache-2.0
// Bodies of luminaires in front of what a viewer's pixel shows: they are met by the pixel's own rays, since they are no
// surfaces of the scene. scene/photometry/luminaire_body.h has the same for paths. Part of view_radiance.glsl.
#include "ies_profile.glsl"
layout(std430, binding = BINDING_LUMINAIRES) readonly buffer LuminaireBuffer {
    LuminaireHead luminaire_head;
    LuminaireData luminaires[];
};

const float no_distance = 1e30;

/// Whether a ray may meet what is in a ball. spread: growth of the ray's radius with its length.
bool passes_ball(vec4 ball, vec3 origin, vec3 direction, float spread, float farthest) {
    vec3 to = ball.xyz - origin;
    float along = dot(to, direction);
    vec3 aside = to - along * direction;
    float radius = ball.w + spread * max(along, 0.0);
    return dot(aside, aside) <= radius * radius && along > -radius && along < farthest + radius;
}

/// As IesProfile::Opening::projected_area(), m². towards: in the luminaire's axes.
float luminous_area(LuminaireData l, vec3 towards) {
    float across_x = abs(towards.x) * (towards.x > 0.0 ? l.heights.x : l.heights.z);
    float across_y = abs(towards.y) * (towards.y > 0.0 ? l.heights.y : l.heights.w);
    vec2 sizes = 2.0 * vec2(l.axis_x.w, l.axis_y.w);
    float plate = abs(towards.z) * sizes.x * sizes.y;
    if (l.profile.y == 0u) {
        return plate + across_x * sizes.y + across_y * sizes.x;
    }
    float sine = length(towards.xy);
    float height = sine > 0.0 ? (across_x * abs(towards.x) + across_y * abs(towards.y)) / (sine * sine) : 0.0;
    return 0.7853981634 * plate + height * sine * max(sizes.x, sizes.y);
}

/// Of what shines on the side that a ray enters by, m. by_x: of a box, by a side that faces along x.
float luminous_height(LuminaireData l, vec3 towards, bool by_x) {
    float on_x = towards.x > 0.0 ? l.heights.x : l.heights.z;
    float on_y = towards.y > 0.0 ? l.heights.y : l.heights.w;
    if (l.profile.y == 0u) {
        return by_x ? on_x : on_y;
    }
    vec2 squares = towards.xy * towards.xy;
    return dot(squares, vec2(on_x, on_y)) / (squares.x + squares.y);
}

/// Radiance of a body towards the origin of a ray, radiance units; w: distance, no_distance where the ray passes by.
vec4 meet_luminaire(LuminaireData l, vec3 origin, vec3 direction) {
    const vec4 nothing = vec4(0.0, 0.0, 0.0, no_distance);
    mat3 axes = mat3(l.axis_x.xyz, l.axis_y.xyz, l.axis_z.xyz);
    vec3 from = origin - l.position.xyz;
    float nearest = -dot(from, direction);
    vec3 o = (from + nearest * direction) * axes;  // the ray's point next to the position
    vec3 d = direction * axes;
    const float parallel = 1e-7;
    d = mix(d, vec3(parallel), lessThan(abs(d), vec3(parallel)));
    vec2 plates = (vec2(l.intensity.w, l.axis_z.w) - o.z) / d.z;
    vec2 sizes = vec2(l.axis_x.w, l.axis_y.w);
    vec2 side;  // where the ray is between the sides
    bool by_x = false;
    if (l.profile.y != 0u) {
        vec2 p = o.xy / sizes;
        vec2 q = d.xy / sizes;
        float a = dot(q, q);
        float b = dot(p, q);
        float square = b * b - a * (dot(p, p) - 1.0);
        if (square < 0.0) {
            return nothing;
        }
        side = (vec2(-sqrt(square), sqrt(square)) - b) / a;
    } else {
        vec2 first = (-sizes - o.xy) / d.xy;
        vec2 second = (sizes - o.xy) / d.xy;
        vec2 ways_in = min(first, second);
        vec2 ways_out = max(first, second);
        side = vec2(max(ways_in.x, ways_in.y), min(ways_out.x, ways_out.y));
        by_x = ways_in.x > ways_in.y;
    }
    float plate_in = min(plates.x, plates.y);
    float way_in = max(side.x, plate_in);
    if (way_in >= min(side.y, max(plates.x, plates.y)) || nearest + way_in <= 0.0) {
        return nothing;
    }
    vec4 met = vec4(0.0, 0.0, 0.0, nearest + way_in);
    bool by_side = side.x > plate_in;
    if (!by_side || o.z + way_in * d.z - l.intensity.w < luminous_height(l, -d, by_x)) {
        float area = luminous_area(l, -d);
        met.rgb = area > 0.0 ? l.intensity.rgb * (ies_intensity(l.profile.x, -d) / area) : vec3(0.0);
    }
    return met;
}

/// The first body that a ray meets from one distance on and before a surface at another one; as meet_luminaire().
vec4 nearest_luminaire(vec3 origin, vec3 direction, float nearest, float surface) {
    vec4 found = vec4(0.0, 0.0, 0.0, no_distance);
    for (uint g = 0u; g < luminaire_head.counts.y; ++g) {
        RARELY(passes_ball(luminaire_head.groups[g].ball, origin, direction, 0.0, surface)) {
            uvec2 range = luminaire_head.groups[g].range.xy;
            for (uint k = range.x; k < range.y; ++k) {
                RARELY(passes_ball(luminaires[k].position, origin, direction, 0.0, surface)) {
                    vec4 met = meet_luminaire(luminaires[k], origin, direction);
                    float tolerance = 1e-3 * luminaires[k].position.w + 1e-5 * met.w;  // LuminaireBody::tolerance()
                    found = met.w >= nearest && met.w < min(surface + tolerance, found.w) ? met : found;
                }
            }
        }
    }
    return found;
}

#ifdef CONTINUED
/// luminaires_before() of the end of a view ray: on its last stretch.
vec4 luminaires_before_end(uint index) {
    vec3 back = continued_towards(index);
    float way = continued[index].way;
    float surface = continued[index].surface == NO_HIT ? no_distance : way;
    vec4 met = nearest_luminaire(continued[index].position + way * back, -back, 0.0, surface);
    return met.w < no_distance ? vec4(met.rgb, 0.0) : vec4(0.0, 0.0, 0.0, 1.0);
}
#else
/// Whether some body may be seen in a pixel.
bool luminaires_near(vec3 direction) {
    float spread = 2.0 * length(view.up.xyz) / float(view.size.y);
    bool near = false;
    for (uint g = 0u; g < luminaire_head.counts.y; ++g) {
        RARELY(passes_ball(luminaire_head.groups[g].ball, view.eye.xyz, direction, spread, no_distance)) {
            uvec2 range = luminaire_head.groups[g].range.xy;
            for (uint k = range.x; k < range.y; ++k) {
                near = near || passes_ball(luminaires[k].position, view.eye.xyz, direction, spread, no_distance);
            }
        }
    }
    return near;
}

/// How far a ray goes to the plane of what a pixel shows, m.
float distance_to_surface(PixelSurface p, vec3 direction) {
    vec4 plane = facet_plane(p.facet & PIXEL_FACET_MASK);
    float distance = (plane.w - dot(plane.xyz, view.eye.xyz)) / dot(plane.xyz, direction);
    bool sky = p.side == NO_PATCH && (p.facet & PIXEL_SKY) != 0u;
    return distance > 0.0 && !sky ? distance : no_distance;
}

/// luminaires_before() of a pixel that they are near: the mean of rays through it.
vec4 luminaires_in_pixel(uint index, uvec2 at, PixelSurface p) {
    uint n = luminaire_head.counts.z;
    vec4 sum = vec4(0.0);
    for (uint k = 0u; k < n * n; ++k) {
        vec2 part = n > 1u ? (vec2(k % n, k / n) + 0.5) / float(n) - 0.5 : place_in_pixel(at);
        vec3 direction = normalize(view_direction(at, part));
        float nearest = luminaire_head.cut.x / dot(view.forward.xyz, direction);
        vec4 met = nearest_luminaire(view.eye.xyz, direction, nearest, distance_to_surface(p, direction));
        bool seen = met.w < no_distance;
#ifdef AIR_BEFORE
        float left = left_before(view.eye.xyz + met.w * direction);
        met.rgb = left * met.rgb + sent_by_air(index, left);
#endif
        sum += seen ? vec4(met.rgb, 0.0) : vec4(0.0, 0.0, 0.0, 1.0);
    }
    return sum / float(n * n);
}
#endif

/// What the luminaires before a pixel's surface add to it, radiance units; w: share of the pixel that they leave.
vec4 luminaires_before(uint index, PixelSurface p) {
    vec4 seen = vec4(0.0, 0.0, 0.0, 1.0);
#ifdef CONTINUED
    RARELY(luminaire_head.counts.x != 0u && continued[index].surface != CONTINUED_NONE) {
        seen = luminaires_before_end(index);
    }
#else
    uint row = index / view.size.x;
    uvec2 at = uvec2(index - row * view.size.x, row);
    RARELY(luminaire_head.counts.x != 0u && luminaires_near(normalize(view_direction(at, place_in_pixel(at))))) {
        seen = luminaires_in_pixel(index, at, p);
    }
#endif
    return seen;
}
