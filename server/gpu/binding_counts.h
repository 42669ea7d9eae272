// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace raybundle {

/// Numbered places that buffers and textures of shaders are bound to.
struct BindingCounts {
    unsigned storage = 0;   ///< shader storage blocks
    unsigned uniforms = 0;  ///< uniform blocks
    unsigned textures = 0;  ///< texture units, of all stages together
};

/// One more than the highest numbers that the shaders' text uses. Needs no context.
BindingCounts bindings_needed();
/// What the driver has.
BindingCounts bindings_of_driver();
/// Throws GpuError that says what there is too little of. Needs no context.
void check_bindings(const BindingCounts& needed, const BindingCounts& driver);

}  // namespace raybundle
