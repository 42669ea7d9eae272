// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bundle/parallel_window.h"
#include "bundle/traced_picture.h"
#include "gpu/gl_objects.h"
#include "gpu/shader_program.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {

/// A parallel bundle split by a plane (ch. 4.3.1, "hardware z-buffer"): along every line the
/// nearest surfaces on both sides of a plane perpendicular to the direction, as two depth-buffered
/// pictures. These surfaces see each other; the plane falls between two surfaces at distance r with
/// probability r/R.
class PlaneWindow {
  public:
    /// n: pixels along the window's side. defines: of the scene to be drawn.
    /// traced: by rays, where the scene has a tracer.
    explicit PlaneWindow(int n, const std::vector<std::string>& defines = {}, bool traced = false);

    /// Finds the surfaces of the scene at a place. The bundle's parameters are bound.
    void draw(const GpuScene& scene, const ParallelWindow& window, Place place);
    /// Unit 0: surface ids, the picture behind the plane (towards -z) in rows [0, n), the one ahead
    /// of it in rows [n, 2n).
    void bind_textures() const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    void raster(const GpuScene& scene, const ParallelWindow& window, Place place) const;
    void trace(const GpuScene& scene, const ParallelWindow& window, Place place);

    int n_;
    bool exact_depths_;
    std::optional<TracedPicture> traced_;
    Texture2D surface_ids_, depths_;
    Framebuffer framebuffer_;
    ShaderProgram raster_;
};

}  // namespace raybundle
