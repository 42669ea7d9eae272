// SPDX-License-Identifier: Apache-2.0
#include "solution/store/gloss_samples.h"

#include "gpu/layouts.h"

namespace raybundle {

GlossSamples::GlossSamples(std::uint32_t patch_count, bool any_glossy) : patch_count_(patch_count) {
    if (any_glossy) {
        gloss_ = Buffer("gloss", std::size_t{patch_count} * sizeof(glm::uvec4));
        chain_ = Buffer("gloss chain", std::size_t{patch_count} * sizeof(glm::vec2));
        gloss_.clear();
        chain_.clear();
        texture_ = create_buffer_texture("gloss", GL_RGBA32UI, gloss_);
        turn_ = ShaderProgram({"solution_turn_gloss.comp"});
    }
}

void GlossSamples::bind() const {
    if (any()) {
        gloss_.bind_storage(BINDING_GLOSS);
        chain_.bind_storage(BINDING_CHAIN);
        glBindTextureUnit(UNIT_GLOSS, texture_.get());
    }
}

void GlossSamples::turn(std::uint32_t object, const glm::mat4& now_from_before) const {
    if (any()) {
        turn_.set("patch_count", patch_count_);
        turn_.set("object", object);
        turn_.set("now_from_before", now_from_before);
        turn_.dispatch(patch_count_);
    }
}

}  // namespace raybundle
