// SPDX-License-Identifier: Apache-2.0
#include "gpu/context_loss.h"

#include <epoxy/gl.h>

#include "gpu/egl_context.h"

namespace raybundle {

void check_context() {
    switch (glGetGraphicsResetStatus()) {
        case GL_NO_ERROR:
            return;
        case GL_GUILTY_CONTEXT_RESET:
            throw GpuError("the driver has reset the GPU because of this program");
        case GL_INNOCENT_CONTEXT_RESET:
            throw GpuError("the driver has reset the GPU because of another program");
        default:
            throw GpuError("the driver has reset the GPU");
    }
}

}  // namespace raybundle
