// SPDX-License-Identifier: Apache-2.0
// Light of many lamps (MANY_LAMPS), a row of slots at a time: rays on the processor have found which of them reach
// each point, see solution/direct/many_lamps.h. Requires first_shot.glsl.
struct LampPoint {  // trace/lamp_rays.h
    vec3 position;
    uint facet;
    vec3 normal;
    uint cell;
};
layout(std430, binding = BINDING_LAMP_POINTS) buffer LampPointBuffer { LampPoint lamp_points[]; };
layout(std430, binding = BINDING_LAMP_MASKS) readonly buffer LampMaskBuffer { uint lamp_masks[]; };
/// Of each cell LAMP_SLOTS lamps, or NO_HIT.
layout(std430, binding = BINDING_LAMP_SLOTS) readonly buffer LampSlotBuffer { uint lamp_slots[]; };
/// Cell of each patch.
layout(std430, binding = BINDING_LAMP_CELLS) readonly buffer LampCellBuffer { uint lamp_cells[]; };

/// Irradiance of a point by a lamp that reaches it.
vec3 lamp_irradiance(uint k, vec3 position, vec3 normal, out vec3 w_in) {
    vec3 to_light;
    return unhindered_irradiance(punctual[k], position, normal, to_light, w_in);
}
