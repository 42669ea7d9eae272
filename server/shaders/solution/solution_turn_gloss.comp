// SPDX-License-Identifier: Apache-2.0
// A moved object takes along the directions from which its glossy patches have accepted light.
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
#include "scene_geometry.glsl"
#include "octahedral.glsl"
layout(std430, binding = BINDING_GLOSS) buffer GlossBuffer { uvec4 gloss[]; };
uniform uint patch_count;
uniform uint object;
uniform mat4 now_from_before;  // rotation

void main() {
    uint i = linear_index();
    if (i < patch_count && floatBitsToUint(patch_attributes(i).z) == object) {
        vec3 direction = mat3(now_from_before) * vector_from_octahedral(unpackSnorm2x16(gloss[i].z));
        gloss[i].z = packSnorm2x16(octahedral_from_vector(direction));
    }
}
