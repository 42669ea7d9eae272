// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/shader_program.h"
#include "solution/geometry/gpu_scene.h"
#include "view/tiles/tile_lists.h"

namespace raybundle {

/// Programs of EdgeFilter that all viewers share.
struct EdgePrograms {
    /// defines: the scene's, and more of what shows radiance.
    EdgePrograms(const GpuScene& scene, const std::vector<std::string>& defines);

    ShaderProgram count, list, finish, average, average_linear;
    std::uint32_t triangle_count;  // of the scene
};

/// Antialiasing of a picture at rest: a box filter over the pixels at the edges of surfaces. Light
/// is gathered at one place of each pixel alone; what else an edge pixel covers is most often some
/// neighbour's surface, and takes its light from there; what is thinner than a pixel takes it from
/// the solution in object space. So only the shares are needed, found by rasterising the
/// scene again through `samples` points of each pixel, and iterations cost no more than without.
/// After A. Reshetov 2009, "Morphological Antialiasing" (blending neighbours), with the coverage of
/// E. Persson 2011, "Geometric Post-process Anti-Aliasing" (true geometry instead of guessed
/// edges).
class EdgeFilter {
  public:
    static constexpr unsigned samples = EDGE_SAMPLES;

    /// size: of the picture, pixels.
    explicit EdgeFilter(glm::uvec2 size);

    /// What the pixels show has changed: all shares are to be found again.
    void restart() { counted_ = 0; }
    [[nodiscard]] bool complete() const { return counted_ == samples; }

    /// Where in the pixels the scene is to be rasterised next, from their centres, pixels: within
    /// (-0.5, 0.5), y upwards. Requires !complete().
    [[nodiscard]] glm::vec2 next_offset() const;
    /// Counts for each pixel whose surface is seen there. The surfaces rasterised at next_offset()
    /// are bound to UNIT_SURFACE_IDS, the picture's pixels and parameters and the scene as well.
    void count(const EdgePrograms& programs);

    // When these are called, the picture's parameters, the scene and the irradiance of its vertices
    // are bound.

    /// The frame (RGBA8, sRGB, row 0 at the top) with its edges smoothed: means of displayed light,
    /// so that bright lamps have smooth edges too. with_strangers: the frame shows light, which
    /// what no pixel shows can be given, too. Requires complete(). Valid until the next call.
    [[nodiscard]] const Buffer& average(const EdgePrograms& programs, const Buffer& frame,
                                        bool with_strangers) const;
    /// The same for radiance (vec4 per pixel).
    [[nodiscard]] Buffer average_linear(const EdgePrograms& programs, const Buffer& frame) const;

    [[nodiscard]] std::size_t bytes() const {
        return counts_.bytes() + smoothed_.bytes() + tiles_.bytes();
    }

  private:
    void average(const ShaderProgram& program, const Buffer& frame, const Buffer& result) const;

    glm::uvec2 size_;
    Buffer counts_, smoothed_;
    TileLists tiles_;       // with edges
    unsigned counted_ = 0;  // sub-samples
};

}  // namespace raybundle
