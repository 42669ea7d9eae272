// SPDX-License-Identifier: Apache-2.0
#include "solution/store/kept_mean.h"

namespace raybundle {

void KeptMean::keep(const Buffer& irradiance) {
    if (kept_.bytes() == 0) {
        kept_ = Buffer("kept irradiance", irradiance.bytes());
        since_ = Buffer("irradiance since the change", irradiance.bytes());
        serve_ = ShaderProgram({"solution_serve.comp"});
    }
    glCopyNamedBufferSubData(irradiance.get(), kept_.get(), 0, 0,
                             static_cast<GLsizeiptr>(kept_.bytes()));
    since_.clear();
    keeping_ = true;
}

void KeptMean::serve(std::uint32_t patch_count) const {
    kept_.bind_storage(BINDING_KEPT);
    since_.bind_storage(BINDING_SINCE);
    serve_.set("patch_count", patch_count);
    serve_.dispatch(patch_count);
}

}  // namespace raybundle
