// SPDX-License-Identifier: Apache-2.0
// What the solution keeps over a change of the scene, apart from what comes in afterwards.
#include "solution/radiance_store.h"

namespace raybundle {

void RadianceStore::keep_light() {
    if (kept_.bytes() == 0) {
        kept_ = Buffer("kept irradiance", irradiance_.bytes());
        since_ = Buffer("irradiance since the change", irradiance_.bytes());
        serve_ = ShaderProgram({"solution_serve.comp"});
    }
    glCopyNamedBufferSubData(irradiance_.get(), kept_.get(), 0, 0,
                             static_cast<GLsizeiptr>(kept_.bytes()));
    since_.clear();
    keeping_ = true;
}

void RadianceStore::serve() const {
    if (!keeping_) {
        return;
    }
    zones_.bind();
    kept_.bind_storage(BINDING_KEPT);
    since_.bind_storage(BINDING_SINCE);
    serve_.set("patch_count", patch_count_);
    serve_.dispatch(patch_count_);
}

Buffer RadianceStore::complete_start() const {
    Buffer completion = Buffer::from<glm::vec4>("completion of the start", zones_.complete_start());
    completion.bind_storage(BINDING_COMPLETION);
    complete_.set("patch_count", patch_count_);
    complete_.dispatch(patch_count_);
    return completion;
}

}  // namespace raybundle
