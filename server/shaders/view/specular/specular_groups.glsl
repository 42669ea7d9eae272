// SPDX-License-Identifier: Apache-2.0
// Groups of SPECULAR_GROUP consecutive pixels of a viewer that show a surface with a specular lobe somewhere:
// what only such surfaces need runs there alone. The order of the list depends on the run, what is done for
// each group does not.
layout(std430, binding = BINDING_SPECULAR_GROUPS) SPECULAR_GROUPS_ACCESS buffer SpecularGroupBuffer {
    uint group_command[3];  // of glDispatchComputeIndirect
    uint group_count;
    uint groups[];
};

const uint groups_a_row = 32768u;

/// The pixel of this invocation, or one beyond the picture.
uint specular_pixel() {
    uint k = gl_WorkGroupID.y * groups_a_row + gl_WorkGroupID.x;
    return k < group_count ? groups[k] * SPECULAR_GROUP + gl_LocalInvocationID.x : 0xffffffffu;
}
