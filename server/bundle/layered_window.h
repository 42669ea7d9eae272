// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "bundle/parallel_window.h"
#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/shader_program.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {

/// A parallel bundle with all surfaces along every line (ch. 4.3.1, "software z-buffer"): one
/// list per window pixel. Hits are never dropped: a window whose lists overflow is counted, not
/// transferred, and drawn again after grow().
class LayeredWindow {
  public:
    /// n: pixels along the window's side. defines: of the scene to be drawn.
    /// traced: by rays, where the scene has a tracer; lists are then in the order of the lines.
    explicit LayeredWindow(int n, const std::vector<std::string>& defines = {},
                           bool traced = false);

    [[nodiscard]] int size() const { return n_; }
    /// Whether lists are in the order of the lines.
    [[nodiscard]] bool in_order() const { return traced_; }

    /// Puts all surfaces into the lists of a rectangle. The bundle's parameters are bound.
    /// `counters` (bound at BINDING_COUNTERS) tell whether lists have overflowed.
    void draw(const GpuScene& scene, const ParallelWindow& window, Place place,
              const PixelRectangle& rectangle, const Buffer& counters) const;
    void bind() const;
    /// Room for this many surfaces along a line. Throws GpuError where memory ends.
    void grow(std::uint32_t capacity);
    [[nodiscard]] std::uint32_t capacity() const { return capacity_; }
    [[nodiscard]] std::size_t bytes() const { return counts_.bytes() + surfaces_.bytes(); }

  private:
    void trace(const GpuScene& scene, const ParallelWindow& window, Place place,
               const PixelRectangle& rectangle, const Buffer& counters) const;
    void empty_lists(const PixelRectangle& rectangle) const;

    int n_;
    bool traced_;
    std::uint32_t capacity_ = 0;  // surfaces along a line
    Buffer counts_, surfaces_;
    Texture2D list_texture_;  // the first four surfaces of every pixel
    Framebuffer framebuffer_;
    ShaderProgram raster_, clear_;
};

}  // namespace raybundle
