// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "bundle/bundle_frame.h"
#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/shader_program.h"
#include "solution/gpu_scene.h"

namespace raybundle {

/// A parallel bundle with all surfaces along every line (ch. 4.3.1, "software z-buffer"): one
/// sorted list per window pixel. Hits are never dropped: a window that needs more nodes than there
/// are is counted, not transferred, and drawn again after grow().
class LayeredWindow {
  public:
    /// n: pixels along the window's side.
    LayeredWindow(const GpuScene& scene, int n);

    /// The window's geometry for a direction: origin at a corner, square pixels, covering the
    /// sphere of the given diameter round the scene's centre, shifted by a random share of a pixel.
    struct Geometry {
        BundleFrame frame;
        float pixel_size = 0.0F;  ///< m
        float depth = 0.0F;       ///< m, along z
    };
    [[nodiscard]] Geometry geometry(const glm::vec3& direction, float angle, const glm::vec2& shift,
                                    const glm::vec3& centre, float diameter) const;

    [[nodiscard]] int size() const { return n_; }
    [[nodiscard]] PixelRectangle full() const { return {0, 0, n_, n_}; }
    [[nodiscard]] PixelRectangle covering(const Geometry& geometry,
                                          std::span<const Bounds> boxes) const;

    /// Rasterises all surfaces into the lists of a rectangle and sorts them. `counters` (bound at
    /// BINDING_COUNTERS) counts the nodes and remembers under `slot` if they were too many.
    void draw(const GpuScene& scene, const Geometry& geometry, Place place,
              const PixelRectangle& rectangle, const Buffer& counters, unsigned slot) const;
    void bind() const;
    /// Room for at least this many nodes. Throws GpuError where memory ends.
    void grow(std::uint32_t nodes);
    [[nodiscard]] std::size_t bytes() const { return heads_.bytes() + nodes_.bytes(); }

  private:
    int n_;
    Buffer heads_, nodes_;
    Framebuffer framebuffer_;
    ShaderProgram raster_, sort_, clear_;
};

}  // namespace raybundle
