// SPDX-License-Identifier: Apache-2.0
// Geometry of the hemicube (ch. 5.1.2): a top face of N x N pixels and four sides of N x N/2, stacked
// in one picture of N x 3N. Face 0 looks along the normal z, faces 1..4 along +x, -x, +y, -y of the
// bundle's frame.

/// Frame of a face in bundle coordinates: columns right, up, forward.
mat3 hemicube_face(int face) {
    vec3 z = vec3(0, 0, 1);
    if (face == 0) {
        return mat3(vec3(0, 1, 0), vec3(1, 0, 0), z);
    }
    vec3 forward = face == 1   ? vec3(1, 0, 0)
                   : face == 2 ? vec3(-1, 0, 0)
                   : face == 3 ? vec3(0, 1, 0)
                               : vec3(0, -1, 0);
    return mat3(cross(forward, z), z, forward);
}

/// Weight of a face of a glossy shooter's hemicube (ch. 5.2).
float face_weight(int face) { return face == 0 ? bundle.constant.w : bundle.side_weights[face - 1]; }

/// Point of the stacked picture that a pixel samples. All pixels share one random shift: a rectangle rule
/// with a random origin, unbiased even for what is always seen through the same pixel.
vec2 sample_point(ivec2 texel) { return vec2(texel) + 0.5 + vec2(bundle.axis_x.w, bundle.axis_y.w); }

/// Pixel that samples nearest to a point.
ivec2 nearest_sample(vec2 point) { return ivec2(floor(point - vec2(bundle.axis_x.w, bundle.axis_y.w))); }

/// Direction through a point of the stacked picture; its component along the face's axis is 1.
/// Bundle coordinates; z is along the shooter's normal.
vec3 hemicube_direction(vec2 pixel, float n, out int face) {
    if (pixel.y < n) {
        face = 0;
        vec2 uv = 2.0 * pixel / n - 1.0;
        return vec3(uv.y, uv.x, 1.0);
    }
    float y = pixel.y - n;
    int side = int(2.0 * y / n);
    face = 1 + side;
    vec2 uv = vec2(2.0 * pixel.x / n - 1.0, 2.0 * (y - float(side) * 0.5 * n) / n);
    return hemicube_face(face) * vec3(uv, 1.0);
}

/// Point of the stacked picture that a direction (bundle coordinates, z > 0) passes; depth is its
/// component along the face's axis.
vec2 hemicube_pixel(vec3 d, float n, out int face, out float depth) {
    vec2 a = abs(d.xy);
    if (d.z >= max(a.x, a.y)) {
        face = 0;
        depth = d.z;
        return (vec2(d.y, d.x) / d.z * 0.5 + 0.5) * n;
    }
    face = a.x >= a.y ? (d.x > 0.0 ? 1 : 2) : (d.y > 0.0 ? 3 : 4);
    depth = max(a.x, a.y);
    vec3 local = transpose(hemicube_face(face)) * d;
    return vec2((local.x / depth * 0.5 + 0.5) * n,
                n + (float(face - 1) + local.y / depth) * 0.5 * n);
}
