// SPDX-License-Identifier: Apache-2.0
#include "view/error/confidence.h"

#include <algorithm>

namespace raybundle {

namespace {

glm::uvec2 tiles_of(glm::uvec2 size) {
    return (size + glm::uvec2(CONFIDENCE_TILE - 1)) / glm::uvec2(CONFIDENCE_TILE);
}

std::size_t count_of(glm::uvec2 grid) {
    return std::size_t{grid.x} * grid.y;
}

}  // namespace

Confidence::Confidence(glm::uvec2 size)
    : sums_("confidence sums", 2 * count_of(tiles_of(size)) * sizeof(glm::vec4)),
      light_("confidence", (CONFIDENCE_WHOLE + count_of(tiles_of(size))) * sizeof(glm::vec2)),
      texture_(create_buffer_texture("confidence", GL_RG32F, light_)) {
    forget();
}

void Confidence::forget() {
    light_.clear();
    restart();
}

void Confidence::inherit(const Confidence& other) const {
    glCopyNamedBufferSubData(other.light_.get(), light_.get(), 0, 0,
                             CONFIDENCE_WHOLE * sizeof(glm::vec2));
}

void Confidence::inherit_tiles(const Confidence& other, unsigned factor) {
    tiles_ = other.tiles_;
    tile_ = other.tile_ * factor;
    glCopyNamedBufferSubData(
        other.light_.get(), light_.get(), 0, 0,
        static_cast<GLsizeiptr>(std::min(other.light_.bytes(), light_.bytes())));
}

void Confidence::restart() {
    next_ = first_look;
    tiles_ = glm::uvec2(0);
}

void Confidence::look(const ConfidencePrograms& programs, glm::uvec2 size,
                      std::uint32_t triangle_count, std::uint64_t samples) {
    const glm::uvec2 tiles = tiles_of(size);
    sums_.bind_storage(BINDING_CONFIDENCE_SUMS);
    light_.bind_storage(BINDING_CONFIDENCE);
    programs.look.set("triangle_count", triangle_count);
    programs.look.dispatch_groups(tiles.x, tiles.y);
    programs.evaluate.set("columns", tiles.x);
    programs.evaluate.set("rows", tiles.y);
    programs.evaluate.set("whole", true);
    programs.evaluate.dispatch(1);
    programs.evaluate.set("whole", false);
    programs.evaluate.dispatch(count_of(tiles));
    tiles_ = tiles;
    tile_ = CONFIDENCE_TILE;
    next_ = 2 * samples;
}

void Confidence::bind() const {
    glBindTextureUnit(UNIT_CONFIDENCE, texture_.get());
}

}  // namespace raybundle
