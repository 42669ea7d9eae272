// SPDX-License-Identifier: Apache-2.0
// Nearest surface: 2 * facet + side (0 front, 1 back).
layout(early_fragment_tests) in;
layout(location = 0) out uint surface;

uniform uint first_facet;

void main() { surface = (first_facet + uint(gl_PrimitiveID)) * 2u + (gl_FrontFacing ? 0u : 1u); }
