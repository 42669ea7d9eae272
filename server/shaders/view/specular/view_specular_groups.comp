// SPDX-License-Identifier: Apache-2.0
// Size of the dispatches over the groups of pixels with specular surfaces.
#include "layouts.glsl"
layout(local_size_x = 1) in;
#define SPECULAR_GROUPS_ACCESS
#include "specular_groups.glsl"

void main() {
    group_command[0] = min(group_count, groups_a_row);
    group_command[1] = (group_count + groups_a_row - 1u) / groups_a_row;
    group_command[2] = 1u;
}
