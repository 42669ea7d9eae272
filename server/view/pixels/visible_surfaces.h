// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "bundle/bundle_frame.h"
#include "bundle/traced_picture.h"
#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "solution/geometry/gpu_scene.h"
#include "view/view_programs.h"

namespace raybundle {

struct RayGrid;

/// The surfaces and depths that a camera sees in the pixels of a picture: rasterised, or found by
/// rays where that is cheaper. Overwritten by each look.
class VisibleSurfaces {
  public:
    /// How a picture is looked at. near: distance of its plane, m.
    struct Look {
        const layout::ViewParameters& view;
        std::span<const std::uint32_t> hidden;  ///< objects
        unsigned grid = 1;                      ///< see ViewerImage::refine()
        float near = 0.0F;
    };

    VisibleSurfaces(const GpuScene& scene, const ViewPrograms& programs, glm::uvec2 size);

    /// What the pixels of a rectangle show.
    void see(const Look& look, const PixelRectangle& rectangle);
    /// What all of them show at one place, pixels from their centres.
    void see_shifted(const Look& look, const glm::vec2& place);
    void bind() const { glBindTextureUnit(UNIT_SURFACE_IDS, ids_.get()); }
    /// Reversed, `near` at the front.
    [[nodiscard]] const Texture2D& depths() const { return depths_; }

  private:
    void trace(const Look& look, std::span<const RayGrid> grids, const PixelRectangle& rectangle);
    void trace_pixels(const Look& look, const PixelRectangle& rectangle);
    void begin_raster(const Look& look, const PixelRectangle& rectangle) const;
    void raster_shifted(const Look& look, const ShaderProgram& program, const glm::vec2& place,
                        const PixelRectangle& rectangle) const;
    void raster_pixels(const Look& look, const PixelRectangle& rectangle) const;

    const GpuScene& scene_;
    const ViewPrograms& programs_;
    Texture2D ids_, depths_;
    std::optional<TracedPicture> traced_;  // only where rays find what pixels see
    Framebuffer framebuffer_;              // only where the rasteriser does
};

}  // namespace raybundle
