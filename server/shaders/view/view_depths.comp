// SPDX-License-Identifier: Apache-2.0
// Inverse depths (1/m) of a picture at a grid of points from corner to corner, row 0 at the top: what the raster has left,
// near over depth (view/camera_matrices.cpp); 0 where nothing is.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(binding = UNIT_DEPTHS) uniform sampler2D depths;
layout(std430, binding = BINDING_FRAME) writeonly buffer FrameBuffer { float inverse_depths[]; };
uniform uint columns;        // at least 2
uniform uint rows;           // likewise
uniform uint width;          // of the picture, which may be less than the texture's
uniform uint height;
uniform float near_distance; // m

void main() {
    uint index = linear_index();
    if (index >= columns * rows) {
        return;
    }
    ivec2 size = ivec2(width, height);
    uvec2 point = uvec2(index % columns, index / columns);
    ivec2 pixel = min(ivec2(vec2(point) / vec2(columns - 1u, rows - 1u) * vec2(size)), size - 1);
    inverse_depths[index] = texelFetch(depths, ivec2(pixel.x, size.y - 1 - pixel.y), 0).r / near_distance;
}
