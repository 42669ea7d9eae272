// SPDX-License-Identifier: Apache-2.0
// Shares of a viewer's edge pixels, two words each. First: how many of EDGE_SAMPLES sub-samples lie on the surface
// that each of the eight neighbours shows, four bits each. Second: how many lie on strangers, which neither the pixel
// nor a neighbour shows (a bar thinner than a pixel), and the patch that the first of them met. The rest is the
// pixel's own. Both 0: no edge.

uint edge_count(uint counts, uint k) { return counts >> (4u * k) & 15u; }

/// Neighbour k (0..7) relative to the pixel, y upwards.
ivec2 edge_neighbour(uint k) {
    int cell = int(k) + (k >= 4u ? 1 : 0);
    return ivec2(cell % 3, cell / 3) - 1;
}

const uint stranger_side_bits = 27u;

uint stranger_count(uint strangers) { return strangers >> stranger_side_bits; }

uint stranger_side(uint strangers) { return strangers & ((1u << stranger_side_bits) - 1u); }

/// With one stranger more, on this side.
uint with_stranger(uint strangers, uint side) {
    return (strangers == 0u ? side : strangers) + (1u << stranger_side_bits);
}
