// SPDX-License-Identifier: Apache-2.0
// Walking the sorted surface lists of a parallel bundle. The axis z of the bundle points away from the
// window's origin; "far-facing" surfaces have their front towards +z.

layout(std430, binding = BINDING_LAYER_HEADS) buffer HeadBuffer { uint heads[]; };
layout(std430, binding = BINDING_LAYER_NODES) buffer NodeBuffer { LayerNode nodes[]; };

/// The window's x, y, z are right-handed with z away from it, which shows the scene mirrored: a triangle
/// that is counter-clockwise in the window has its front towards +z.
bool faces_far(uint surface) { return (surface & 1u) == 0u; }

/// Patch on the side of a surface that looks towards +z (far = true) or -z, or NO_PATCH.
uint patch_on_side(uint surface, bool far) {
    return patch_of_surface((surface & ~1u) | (far == faces_far(surface) ? 0u : 1u));
}
