// SPDX-License-Identifier: Apache-2.0
// Empties the lists of a rectangle of the layered window.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_LAYER_COUNTS) writeonly buffer CountBuffer { uint layer_counts[]; };
uniform uint window_width;
uniform uint first_column;
uniform uint first_row;
uniform uint columns;
uniform uint rows;

void main() {
    uint row = linear_index() / columns;
    if (row < rows) {
        layer_counts[(first_row + row) * window_width + first_column + linear_index() - row * columns] = 0u;
    }
}
