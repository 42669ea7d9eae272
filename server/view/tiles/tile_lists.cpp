// SPDX-License-Identifier: Apache-2.0
#include "view/tiles/tile_lists.h"

#include <algorithm>
#include <cstdint>

namespace raybundle {

namespace {

unsigned tiles_of(glm::uvec2 size) {
    const glm::uvec2 tiles = (size + glm::uvec2(VIEW_TILE - 1)) / glm::uvec2(VIEW_TILE);
    return tiles.x * tiles.y;
}

std::size_t commands_bytes(unsigned lists) {
    return lists * sizeof(glm::uvec4);
}

}  // namespace

TileLists::TileLists(const std::string& label, glm::uvec2 size, unsigned lists)
    : tile_count_(tiles_of(size)),
      list_count_(lists),
      lists_(label,
             commands_bytes(lists) + std::size_t{lists} * tile_count_ * sizeof(std::uint32_t)) {
    lists_.clear();
}

void TileLists::begin() const {
    lists_.clear(commands_bytes(list_count_));
    bind();
}

void TileLists::end(const ShaderProgram& finish) const {
    finish.dispatch(list_count_);
}

void TileLists::dispatch(const ShaderProgram& program, unsigned list) const {
    bind();
    program.dispatch_indirect(lists_, list * sizeof(glm::uvec4));
}

void TileLists::dispatch_all(const ShaderProgram& program) const {
    constexpr unsigned tiles_a_row = 32768;  // as in tiles.glsl
    bind();
    program.dispatch_groups(std::min(tile_count_, tiles_a_row),
                            (tile_count_ + tiles_a_row - 1) / tiles_a_row);
}

}  // namespace raybundle
