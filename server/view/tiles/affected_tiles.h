// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "gpu/layouts.h"
#include "gpu/shader_program.h"
#include "solution/geometry/gpu_scene.h"
#include "transport/bundle_receiver.h"
#include "view/tiles/tile_lists.h"

namespace raybundle {

/// Programs of AffectedTiles that all viewers share.
struct AffectedTilePrograms {
    explicit AffectedTilePrograms(const GpuScene& scene);

    ShaderProgram find, finish;
};

/// The tiles of a viewer's pixels that the difference between a bundle before and after a move can
/// reach, found for several bundles at once; see view_affected_tiles.comp. Everywhere else both
/// transfers cancel exactly, so that they need not be made.
class AffectedTiles {
  public:
    /// size: of the picture, pixels.
    explicit AffectedTiles(glm::uvec2 size);

    /// Lists the tiles for at most MOST_DIFFERENCES pairs of bundles. The viewer's pixels and
    /// parameters are bound. boxes: that hold what has moved at either place, shifted world.
    void find(const AffectedTilePrograms& programs, std::span<const BundleRays> bundles,
              std::span<const Bounds> boxes) const;
    /// Runs a program that includes pixel_receiver.glsl, a work group for each of the tiles of a
    /// pair of bundles; glossy: on those with glossy pixels.
    void dispatch(const ShaderProgram& program, unsigned bundles, bool glossy) const;
    /// The same on all tiles.
    void dispatch_all(const ShaderProgram& program) const;
    [[nodiscard]] std::size_t bytes() const { return tiles_.bytes(); }

  private:
    TileLists tiles_;
};

}  // namespace raybundle
