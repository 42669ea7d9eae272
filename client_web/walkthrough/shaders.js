// SPDX-License-Identifier: Apache-2.0
// What the page draws with: the object-space part of the server's view_radiance.glsl. Tone curve and false colour are
// the server's own texts, which come with the scene.

/** What a picture shows; numbers are those of MODE in the shaders. */
export const MODES = /** @type {const} */ ({photo: 0, luminance: 1, illuminance: 2, brightness: 3, linear: 4, distance: 5, normal: 6, glass: 7});

/** Attributes of vertices by their places. */
export const ATTRIBUTES = /** @type {const} */ ({vertex: 0, front: 1, back: 2, emission: 3, uv: 4, colour: 5});

/** Nodes of an albedo row, as server/walkthrough/surface_albedo.h has them. */
export const ALBEDO_NODES = 32;

const HEAD = `#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
`;

export const SURFACE_VERTEX = `${HEAD}
layout(location = ${ATTRIBUTES.vertex}) in uvec3 packed_vertex;
layout(location = ${ATTRIBUTES.front}) in uint front_light;
layout(location = ${ATTRIBUTES.back}) in uint back_light;
layout(location = ${ATTRIBUTES.emission}) in uint own_emission;
layout(location = ${ATTRIBUTES.uv}) in vec2 vertex_uv;
layout(location = ${ATTRIBUTES.colour}) in vec4 vertex_colour;
uniform mat4 clip_from_world;
uniform mat4 world_from_start;  // of the object, which has been moved
uniform vec3 grid_origin, grid_step, emission;
uniform float light_unit;
// At the edge of a triangle the middle of a pixel may lie outside, and what is extrapolated to it has no meaning.
centroid out vec3 position, normal, front, back, emitted, colour;
centroid out vec2 uv;

vec3 from_rgb9e5(uint bits) {
    float unit = exp2(float(bits >> 27u) - 24.0);
    return unit * light_unit * vec3(bits & 511u, bits >> 9u & 511u, bits >> 18u & 511u);
}

vec3 from_octahedral(vec2 p) {
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float below = max(-n.z, 0.0);
    n.xy -= below * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
    return normalize(n);
}

void main() {
    uvec3 v = packed_vertex;
    uvec3 place = uvec3(v.x & 0x1fffffu, v.x >> 21u | (v.y & 0x3ffu) << 11u, v.y >> 10u & 0x1fffffu);
    position = (world_from_start * vec4(grid_origin + grid_step * vec3(place), 1.0)).xyz;
    ivec2 bytes = ivec2(int(v.z << 24u) >> 24, int(v.z << 16u) >> 24);
    mat3 m = mat3(world_from_start);  // normals go by its cofactors
    normal = mat3(cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])) * from_octahedral(vec2(bytes) / 127.0);
    front = from_rgb9e5(front_light);
    back = from_rgb9e5(back_light);
    emitted = emission + from_rgb9e5(own_emission);
    uv = vertex_uv;
    colour = vertex_colour.rgb * vertex_colour.rgb;
    gl_Position = clip_from_world * vec4(position, 1.0);
}
`;

export const SKY_VERTEX = `${HEAD}
uniform vec3 forward, right, up;
out vec3 direction;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    direction = forward + corner.x * right + corner.y * up;
    gl_Position = vec4(corner, 1.0, 1.0);
}
`;

export const PLATE_VERTEX = `${HEAD}
uniform mat4 clip_from_world;
uniform vec3 middle, half_x, half_y;
out vec2 at;

void main() {
    at = vec2((gl_VertexID & 1) == 0 ? -1.0 : 1.0, (gl_VertexID & 2) == 0 ? -1.0 : 1.0);
    gl_Position = clip_from_world * vec4(middle + at.x * half_x + at.y * half_y, 1.0);
}
`;

/**
 * What becomes of radiance (cd/m²) and irradiance / pi in each mode.
 *
 * @param {{toneCurve: string, falseColour: string}} shaders
 */
const output = ({toneCurve, falseColour}) => `
${toneCurve}
${falseColour}
uniform int mode;
uniform float display_factor;  // of photographs: from cd/m² to the tone curve's input
uniform float scale_maximum;   // of false colour, cd/m² or lx
uniform float scale_begin;     // likewise; 0: linear
out vec4 shown;

/// Logarithm of the luminance in 16 bits, for the exposure; blue: it counts.
vec4 brightness(vec3 radiance, bool counts) {
    float stops = clamp(log2(max(luminance(radiance), 1e-4)) / 64.0 + 0.5, 0.0, 1.0) * 65535.0;
    return vec4(floor(stops / 256.0) / 255.0, mod(floor(stops), 256.0) / 255.0, counts ? 1.0 : 0.0, 1.0);
}

vec4 output_of(vec3 radiance, float illuminance, bool counts) {
    if (mode == ${MODES.luminance}) return vec4(false_colour(luminance(radiance), scale_begin, scale_maximum), 1.0);
    if (mode == ${MODES.illuminance}) return vec4(false_colour(illuminance, scale_begin, scale_maximum), 1.0);
    if (mode == ${MODES.brightness}) return brightness(radiance, counts);
    if (mode == ${MODES.linear}) return vec4(radiance, 1.0);
    return vec4(srgb_encoded(shoulder(radiance * display_factor)), 1.0);
}
`;

/** @param {{toneCurve: string, falseColour: string}} shaders */
export const surfaceFragment = (shaders) => `${HEAD}
centroid in vec3 position, normal, front, back, emitted, colour;
centroid in vec2 uv;
uniform vec3 eye, base_colour, transmittance, transparency;
uniform float alpha_cutoff;
uniform bool two_sided, textured, unlit;
uniform int albedo_row;  // -1: the base colour at every angle
uniform sampler2D base_texture, albedo_table;
${output(shaders)}
const float pi = 3.14159265359;
const float unlit_white = 80.0;  // cd/m²

/// Directional albedo at the angle of view.
vec3 albedo_of(vec3 base, bool from_front) {
    if (albedo_row < 0) return base;
    vec3 facing = from_front ? normal : -normal;
    float cosine = clamp(dot(normalize(facing), normalize(eye - position)), 0.0, 1.0);
    float node = sqrt(cosine) * ${ALBEDO_NODES - 1}.0;
    int first = min(int(node), ${ALBEDO_NODES - 2});
    vec4 low = texelFetch(albedo_table, ivec2(first, albedo_row), 0);
    vec4 high = texelFetch(albedo_table, ivec2(first + 1, albedo_row), 0);
    vec4 row = mix(low, high, node - float(first));
    return row.rgb + row.a * base;
}

/// A distance in 24 bits of its logarithm, m.
vec4 distance_code(float metres) {
    float code = clamp(log2(metres) / 64.0 + 0.5, 0.0, 1.0) * 16777215.0;
    vec3 bytes = floor(vec3(code / 65536.0, mod(code / 256.0, 256.0), mod(code, 256.0)));
    return vec4(bytes / 255.0, 1.0);
}

void main() {
    vec4 texel = textured ? texture(base_texture, uv) : vec4(1.0);
    if (alpha_cutoff > 0.0 && texel.a < alpha_cutoff) discard;
    vec3 base = clamp(base_colour * texel.rgb * colour, 0.0, 0.999);
    bool from_front = gl_FrontFacing;
    if (mode == ${MODES.glass}) {
        shown = vec4(srgb_encoded(transparency), 1.0);
        return;
    }
    if (!from_front && !two_sided) {
        shown = output_of(vec3(0.0), 0.0, false);
        return;
    }
    if (mode == ${MODES.distance} || mode == ${MODES.normal}) {
        vec3 flat_normal = normalize(cross(dFdx(position), dFdy(position)));
        shown = mode == ${MODES.normal} ? vec4(0.5 + 0.5 * flat_normal, 1.0) : distance_code(distance(eye, position));
        return;
    }
    vec3 light = from_front ? front : back;
    vec3 behind = from_front ? back : front;
    vec3 radiance = emitted + albedo_of(base, from_front) * light + transmittance * behind;
    if (unlit) {
        if (mode == ${MODES.photo}) {
            shown = vec4(srgb_encoded(base), 1.0);
            return;
        }
        radiance = unlit_white * base;
    }
    if (transparency != vec3(0.0)) {  // over what is behind it
        shown = vec4(output_of(light, 0.0, false).rgb, luminance(albedo_of(vec3(0.0), from_front)));
        return;
    }
    shown = output_of(radiance, pi * luminance(light), emitted == vec3(0.0));
}
`;

/** @param {{toneCurve: string, falseColour: string}} shaders */
export const skyFragment = (shaders) => `${HEAD}
in vec3 direction;
uniform vec3 uniform_sky, sun_direction, sun_radiance;
uniform float sun_cosine, light_unit;
uniform bool has_texels;
uniform sampler2D sky_texels;
${output(shaders)}
const float inverse_pi = 0.31830988618;

void main() {
    vec3 d = normalize(direction);
    vec3 radiance = uniform_sky;
    if (has_texels) {
        float azimuth = d.x != 0.0 || d.z != 0.0 ? atan(d.x, -d.z) : 0.0;
        vec2 at = vec2(0.5 * azimuth * inverse_pi + 0.5, acos(clamp(d.y, -1.0, 1.0)) * inverse_pi);
        radiance += light_unit * textureLod(sky_texels, at, 0.0).rgb;
        if (dot(d, sun_direction) > sun_cosine && d.y >= 0.0) radiance += sun_radiance;
    }
    shown = output_of(radiance, 0.0, false);
}
`;

/** @param {{toneCurve: string, falseColour: string}} shaders */
export const plateFragment = (shaders) => `${HEAD}
in vec2 at;
uniform vec3 radiance;
uniform bool is_round;
${output(shaders)}

void main() {
    if (is_round && dot(at, at) > 1.0) discard;
    shown = output_of(radiance, 0.0, false);
}
`;
