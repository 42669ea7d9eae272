// SPDX-License-Identifier: Apache-2.0
// World positions of all vertices at one place of the objects (0 now, 1 before the change).
#include "layouts.glsl"
layout(local_size_x = 64) in;
#include "linear_index.glsl"
layout(std430, binding = BINDING_VERTICES) readonly buffer VertexBuffer { vec4 vertices[]; };
layout(std430, binding = BINDING_OBJECTS) readonly buffer ObjectBuffer { mat4 world_from_object[]; };
layout(std430, binding = BINDING_WORLD_POSITIONS) writeonly buffer WorldBuffer { vec4 world[]; };
uniform uint place;
uniform uint vertex_count;
uniform uint object_count;

void main() {
    uint i = linear_index();
    if (i >= vertex_count) {
        return;
    }
    vec4 vertex = vertices[i];
    mat4 matrix = world_from_object[place * object_count + floatBitsToUint(vertex.w)];
    world[place * vertex_count + i] = vec4((matrix * vec4(vertex.xyz, 1.0)).xyz, vertex.w);
}
