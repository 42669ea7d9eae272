// SPDX-License-Identifier: Apache-2.0
// Shares of a viewer's edge pixels: how many of EDGE_SAMPLES sub-samples lie on the surface that each of the
// eight neighbours shows, four bits each; the rest is the pixel's own. 0: no edge.

uint edge_count(uint counts, uint k) { return counts >> (4u * k) & 15u; }

/// Neighbour k (0..7) relative to the pixel, y upwards.
ivec2 edge_neighbour(uint k) {
    int cell = int(k) + (k >= 4u ? 1 : 0);
    return ivec2(cell % 3, cell / 3) - 1;
}
