// SPDX-License-Identifier: Apache-2.0
// Facets: the flat triangles that are rasterised, and the way from a point of a facet to the one of the
// triangles tiling it that the point lies on. Surfaces are numbered 2 * facet + side (0 front, 1 back).
#define FACETS  // for what can be included beside this
layout(binding = UNIT_FACETS) uniform samplerBuffer facet_texels;
layout(binding = UNIT_FACET_NODES) uniform usamplerBuffer facet_node_texels;

struct Facet {
    vec4 plane;    // front: dot(plane.xyz, x) = plane.w
    vec4 weight1;  // dot(weight1, vec4(x, 1)): barycentric weight of corner 1
    vec4 weight2;
    uvec2 root;    // FacetNode
};

/// index: facet + base of the place.
vec4 facet_plane(uint index) { return texelFetch(facet_texels, int(4u * index)); }

uint facet_object(uint index) { return floatBitsToUint(texelFetch(facet_texels, int(4u * index + 3u)).z); }

uint facet_material(uint index) { return floatBitsToUint(texelFetch(facet_texels, int(4u * index + 3u)).w); }

Facet load_facet(uint index) {
    int at = int(4u * index);
    return Facet(texelFetch(facet_texels, at), texelFetch(facet_texels, at + 1), texelFetch(facet_texels, at + 2),
                 floatBitsToUint(texelFetch(facet_texels, at + 3).xy));
}

/// One bisection of scene/contact/facet_tree.h: from a triangle to the half with the point.
void descend(uint code, inout uint bisection, inout uint exit, inout vec3 weights, inout vec3 slope) {
    uint edge = code >> (2u * bisection) & 3u;
    bool whole = edge == 3u;
    vec3 w = edge == 1u ? weights.yzx : edge == 2u ? weights.zxy : weights;
    vec3 s = edge == 1u ? slope.yzx : edge == 2u ? slope.zxy : slope;
    bool second = !whole && w.x < w.y;
    float dw = w.x - w.y;
    float ds = s.x - s.y;
    weights = whole ? w : second ? vec3(2.0 * w.x, -dw, w.z) : vec3(dw, 2.0 * w.y, w.z);
    slope = whole ? s : second ? vec3(2.0 * s.x, -ds, s.z) : vec3(ds, 2.0 * s.y, s.z);
    uint bit = second ? 1u : 0u;
    exit = 2u * exit + bit;
    bisection = 2u * bisection + 1u + bit;
}

/// Triangle of a facet at a point, by the barycentric weights of the facet's corners there, up to a
/// positive factor. slope: their change along some line, up to the same factor. Both become those of the
/// triangle. node: the facet's root.
uint triangle_at(uvec2 node, inout vec3 weights, inout vec3 slope) {
    const uint max_depth = 24u;  // 72 bisections
    for (uint depth = 0u; depth < max_depth && (node.x & FACET_LEAF) == 0u; ++depth) {
        uint bisection = 0u;
        uint exit = 0u;
        descend(node.x, bisection, exit, weights, slope);
        descend(node.x, bisection, exit, weights, slope);
        descend(node.x, bisection, exit, weights, slope);
        node = texelFetch(facet_node_texels, int(node.y + exit)).xy;
    }
    return node.y;
}

/// Whether a ray in world space meets a facet.
bool meets_facet(Facet facet, vec3 point, vec3 direction) {
    float distance = (facet.plane.w - dot(facet.plane.xyz, point)) / dot(facet.plane.xyz, direction);
    vec4 met = vec4(point + distance * direction, 1.0);
    float w1 = dot(facet.weight1, met);
    float w2 = dot(facet.weight2, met);
    return distance > 0.0 && min(min(w1, w2), 1.0 - w1 - w2) >= 0.0;
}

/// Triangle of a facet at a world point on it, and the point's barycentric weights there.
uint triangle_at(Facet facet, vec3 point, out vec3 weights) {
    float w1 = dot(facet.weight1, vec4(point, 1.0));
    float w2 = dot(facet.weight2, vec4(point, 1.0));
    weights = vec3(1.0 - w1 - w2, w1, w2);
    vec3 slope = vec3(0.0);
    return triangle_at(facet.root, weights, slope);
}

uint triangle_at(Facet facet, vec3 point) {
    vec3 weights;
    return triangle_at(facet, point, weights);
}
