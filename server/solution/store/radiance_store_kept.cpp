// SPDX-License-Identifier: Apache-2.0
// What the solution keeps over a change of the scene, apart from what comes in afterwards.
#include "solution/store/radiance_store.h"

namespace raybundle {

void RadianceStore::keep_light() {
    kept_.keep(light_.irradiance);
}

void RadianceStore::serve() const {
    if (kept_.keeping()) {
        zones_.bind();
        kept_.serve(patch_count_);
    }
}

void RadianceStore::merge(std::span<const glm::vec4> others, float sequences) {
    kept_.merge(light_.irradiance, others, sequences);
    bind();
    serve();
}

Buffer RadianceStore::complete_start() const {
    Buffer completion = Buffer::from<glm::vec4>("completion of the start", zones_.complete_start());
    completion.bind_storage(BINDING_COMPLETION);
    complete_.set("patch_count", patch_count_);
    if (kept_.keeping()) {
        kept_.since().bind_storage(BINDING_IRRADIANCE);
    }
    complete_.dispatch(patch_count_);
    light_.irradiance.bind_storage(BINDING_IRRADIANCE);
    return completion;
}

}  // namespace raybundle
