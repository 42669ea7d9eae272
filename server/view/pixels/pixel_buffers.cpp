// SPDX-License-Identifier: Apache-2.0
#include "view/pixels/pixel_buffers.h"

#include "gpu/layouts.h"

namespace raybundle {

namespace {

std::size_t bytes_of(const PixelBuffers::Picture& picture) {
    return picture.surfaces.bytes() + picture.irradiance.bytes() + picture.gloss.bytes();
}

}  // namespace

PixelBuffers::Picture::Picture(glm::uvec2 size, const ReflectanceTables& reflectance)
    : surfaces("pixels", pixel_count(size) * sizeof(layout::PixelSurface)),
      irradiance("pixel irradiance", pixel_count(size) * sizeof(glm::vec4)),
      surface_texture(create_buffer_texture("pixels", GL_RGBA32UI, surfaces)),
      irradiance_texture(create_buffer_texture("pixel irradiance", GL_RGBA32F, irradiance)) {
    if (reflectance.any_glossy()) {
        const std::size_t values = reflectance.draws_lobes() ? 2 : 1;
        gloss = Buffer("pixel gloss", values * pixel_count(size) * sizeof(glm::vec4));
        gloss_texture = create_buffer_texture("pixel gloss", GL_RGBA32F, gloss);
    }
}

PixelBuffers::PixelBuffers(glm::uvec2 size, const ReflectanceTables& reflectance)
    : now_(size, reflectance),
      before_(size, reflectance),
      increments_("pixel increments", pixel_count(size) * sizeof(glm::vec4)),
      kept_("kept pixel irradiance", pixel_count(size) * sizeof(glm::vec4)),
      kept_texture_(create_buffer_texture("kept pixel irradiance", GL_RGBA32F, kept_)),
      scatter_("pixel scatter", pixel_count((size + 3U) / 4U) * SCATTER_SUMS * sizeof(float)) {
    if (reflectance.any_glossy()) {
        gloss_increments_ = Buffer("pixel gloss increments", pixel_count(size) * sizeof(glm::vec4));
    }
    clear_increments();
    kept_.clear();
    scatter_.clear();
}

void PixelBuffers::bind() const {
    now_.surfaces.bind_storage(BINDING_PIXELS);
    now_.irradiance.bind_storage(BINDING_PIXEL_IRRADIANCE);
    increments_.bind_storage(BINDING_PIXEL_DELTA);
    scatter_.bind_storage(BINDING_PIXEL_SCATTER);
    glBindTextureUnit(UNIT_PIXELS, now_.surface_texture.get());
    glBindTextureUnit(UNIT_PIXEL_IRRADIANCE, now_.irradiance_texture.get());
    glBindTextureUnit(UNIT_PIXEL_KEPT, kept_texture_.get());
    if (glossy()) {
        now_.gloss.bind_storage(BINDING_PIXEL_GLOSS);
        gloss_increments_.bind_storage(BINDING_PIXEL_GLOSS_DELTA);
        glBindTextureUnit(UNIT_PIXEL_GLOSS, now_.gloss_texture.get());
    }
}

void PixelBuffers::bind_before() const {
    glBindTextureUnit(UNIT_OLD_PIXELS, before_.surface_texture.get());
    glBindTextureUnit(UNIT_OLD_PIXEL_IRRADIANCE, before_.irradiance_texture.get());
    glBindTextureUnit(UNIT_OLD_PIXEL_GLOSS, before_.gloss_texture.get());
}

void PixelBuffers::bind_kept() const {
    kept_.bind_storage(BINDING_PIXEL_DELTA);
}

void PixelBuffers::copy_rows(const PixelRectangle& rectangle, std::size_t columns) const {
    const auto copy = [&](const Buffer& from, const Buffer& to, std::size_t bytes_a_pixel) {
        const std::size_t row = columns * bytes_a_pixel;
        const auto offset = static_cast<GLintptr>(static_cast<std::size_t>(rectangle.y0) * row);
        glCopyNamedBufferSubData(
            from.get(), to.get(), offset, offset,
            static_cast<GLsizeiptr>(static_cast<std::size_t>(rectangle.height()) * row));
    };
    copy(now_.surfaces, before_.surfaces, sizeof(layout::PixelSurface));
    copy(now_.irradiance, before_.irradiance, sizeof(glm::vec4));
    if (glossy()) {
        copy(now_.gloss, before_.gloss, sizeof(glm::vec4));
    }
}

void PixelBuffers::clear_increments() const {
    increments_.clear();
    if (glossy()) {
        gloss_increments_.clear();
    }
}

void PixelBuffers::clear_lobes(std::size_t pixels) const {
    const std::size_t half = pixels * sizeof(glm::vec4);
    glClearNamedBufferSubData(now_.gloss.get(), GL_R32F, static_cast<GLintptr>(half),
                              static_cast<GLsizeiptr>(half), GL_RED, GL_FLOAT, nullptr);
}

std::size_t PixelBuffers::bytes() const {
    return bytes_of(now_) + bytes_of(before_) + increments_.bytes() + gloss_increments_.bytes() +
           kept_.bytes() + scatter_.bytes();
}

}  // namespace raybundle
