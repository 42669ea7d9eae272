// SPDX-License-Identifier: Apache-2.0
// Pixels of a viewer that other surfaces are near to (view_crowded.comp): what only they need runs there alone. The
// order of the list depends on the run, what is done for each pixel does not.
layout(std430, binding = BINDING_CROWDED) CROWDED_ACCESS buffer CrowdedBuffer {
    uint crowded_command[3];  // of glDispatchComputeIndirect, groups of CROWDED_GROUP
    uint crowded_count;
    uint crowded_pixels[];
};

const uint crowded_groups_a_row = 32768u;
