// SPDX-License-Identifier: Apache-2.0
// Nearest surface: 2 * triangle + side (0 front, 1 back).
layout(early_fragment_tests) in;
layout(location = 0) out uint surface;

uniform uint first_triangle;

void main() { surface = (first_triangle + uint(gl_PrimitiveID)) * 2u + (gl_FrontFacing ? 0u : 1u); }
