// SPDX-License-Identifier: Apache-2.0
#include "solution/store/sent_radiance.h"

#include <utility>

namespace raybundle {

SentRadiance::SentRadiance(const GpuScene& scene, const Buffer& radiance)
    : patch_count_(scene.patch_count()),
      texture_(create_buffer_texture("radiance", GL_RGBA32F, radiance)) {
    if (scene.reflectance().any_glossy()) {
        along_bundle_ = Buffer("sent radiance", radiance.bytes());
        bundle_texture_ = create_buffer_texture("sent radiance", GL_RGBA32F, along_bundle_);
        send_ = ShaderProgram({"transport_sent_radiance.comp"}, scene.defines());
    }
}

void SentRadiance::bind(const Buffer& radiance) const {
    (other_ != nullptr ? *other_ : radiance).bind_storage(BINDING_RADIANCE);
    glBindTextureUnit(UNIT_RADIANCE,
                      (other_texture_ != nullptr ? *other_texture_ : texture_).get());
}

void SentRadiance::send_along_bundle(const GpuScene& scene, Place place) const {
    if (along_bundle_.bytes() > 0 && other_ == nullptr) {
        along_bundle_.bind_storage(BINDING_SENT);
        send_.set("patch_count", patch_count_);
        send_.set("patch_base", scene.patch_base(place));
        send_.set("vertex_base", scene.vertex_base(place));
        send_.dispatch(patch_count_);
        glBindTextureUnit(UNIT_RADIANCE, bundle_texture_.get());
    }
    if (placed_ && scene.rescaled()) {
        placed_->radiance.bind_storage(BINDING_SENT);
        placed_->program.set("patch_count", patch_count_);
        placed_->program.set("patch_base", scene.patch_base(place));
        placed_->program.dispatch(patch_count_);
        glBindTextureUnit(UNIT_RADIANCE, placed_->texture.get());
    }
}

void SentRadiance::follow_sizes(const GpuScene& scene) {
    if (placed_ || !scene.rescaled()) {
        return;
    }
    Buffer radiance("placed radiance", std::size_t{patch_count_} * sizeof(glm::vec4));
    Texture2D texture = create_buffer_texture("placed radiance", GL_RGBA32F, radiance);
    placed_.emplace(Placed{std::move(radiance), std::move(texture),
                           ShaderProgram({"transport_placed_radiance.comp"})});
}

void SentRadiance::send_other(const Buffer& radiance, const Texture2D& texture) {
    other_ = &radiance;
    other_texture_ = &texture;
}

void SentRadiance::stop_sending_other() {
    other_ = nullptr;
    other_texture_ = nullptr;
}

std::size_t SentRadiance::bytes() const {
    return along_bundle_.bytes() + (placed_ ? placed_->radiance.bytes() : 0);
}

}  // namespace raybundle
