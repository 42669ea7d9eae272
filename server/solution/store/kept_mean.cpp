// SPDX-License-Identifier: Apache-2.0
#include "solution/store/kept_mean.h"

namespace raybundle {

void KeptMean::make_buffers(const Buffer& irradiance) {
    if (kept_.bytes() == 0) {
        kept_ = Buffer("kept irradiance", irradiance.bytes());
        since_ = Buffer("irradiance since the change", irradiance.bytes());
        serve_ = ShaderProgram({"solution_serve.comp"});
    }
}

void KeptMean::keep(const Buffer& irradiance) {
    make_buffers(irradiance);
    glCopyNamedBufferSubData(irradiance.get(), kept_.get(), 0, 0,
                             static_cast<GLsizeiptr>(kept_.bytes()));
    since_.clear();
    keeping_ = true;
    nothing_kept_ = false;
    merging_ = false;
}

void KeptMean::merge(const Buffer& irradiance, std::span<const glm::vec4> others, float sequences) {
    if (!keeping_ && mixed_) {
        keep(irradiance);
    } else if (!keeping_) {
        make_buffers(irradiance);
        glCopyNamedBufferSubData(irradiance.get(), since_.get(), 0, 0,
                                 static_cast<GLsizeiptr>(since_.bytes()));
        kept_.clear();
        keeping_ = true;
        nothing_kept_ = true;
    }
    if (others_.bytes() == 0) {
        others_ = Buffer("irradiance of other workers", irradiance.bytes());
        serve_merged_ = ShaderProgram({"solution_serve.comp"}, {"MERGED 1"});
    }
    others_.write(others, 0);
    sequences_ = sequences;
    merging_ = true;
}

void KeptMean::serve(std::uint32_t patch_count) const {
    const ShaderProgram& serve = merging_ ? serve_merged_ : serve_;
    kept_.bind_storage(BINDING_KEPT);
    since_.bind_storage(BINDING_SINCE);
    if (merging_) {
        others_.bind_storage(BINDING_OTHERS);
    }
    serve.set("patch_count", patch_count);
    serve.dispatch(patch_count);
}

}  // namespace raybundle
