// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/shader_program.h"

namespace raybundle {

/// Lists of tiles of a viewer's picture, made on the GPU; see tiles.glsl. What only some tiles need
/// is dispatched over them alone.
class TileLists {
  public:
    /// size: of the picture, pixels.
    TileLists(const std::string& label, glm::uvec2 size, unsigned lists);

    void bind() const { lists_.bind_storage(BINDING_TILES); }
    void begin() const;  ///< empties and binds the lists
    /// The lists are complete. finish: view_tile_commands.comp.
    void end(const ShaderProgram& finish) const;
    /// Runs a program with one work group for each tile of a list.
    void dispatch(const ShaderProgram& program, unsigned list) const;
    /// The same on all tiles.
    void dispatch_all(const ShaderProgram& program) const;
    [[nodiscard]] unsigned tile_count() const { return tile_count_; }
    [[nodiscard]] std::size_t bytes() const { return lists_.bytes(); }

  private:
    unsigned tile_count_, list_count_;
    Buffer lists_;
};

}  // namespace raybundle
