// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>

#include "gpu/gl_objects.h"
#include "gpu/readback.h"
#include "view/depth_grid.h"
#include "view/filters/edge_filter.h"
#include "view/pixels/pixel_accumulator.h"
#include "view/view_programs.h"

namespace raybundle {

enum class DisplayMode { photo = 0, false_luminance = 1, false_illuminance = 2 };

/// How false colour shows a quantity: three decades below `maximum`, or evenly from 0 on, with
/// lines or without.
struct ColourScale {
    float maximum = 1000.0F;  ///< cd/m² or lx
    float isolines = 0.0F;    ///< unit of the values with lines, cd/m² or lx; 0: none
    bool linear = false;
};

/// How a picture for people shows radiance. exposure: EV.
struct PictureLook {
    DisplayMode mode = DisplayMode::photo;
    float exposure = 0.0F;
    ColourScale scale;
    bool automatic = false;  ///< the picture's own automatic exposure comes to `exposure`
    bool cut = false;        ///< a plan or section: what is cut through is hatched, not black
};

/// Makes frames for people of what pixels show, and brings them, and depths, from the GPU.
class FrameComposer {
  public:
    /// size: of the largest frame, pixels.
    explicit FrameComposer(glm::uvec2 size) { allocate(size); }
    /// Another one; a frame under way is lost.
    void allocate(glm::uvec2 size);

    /// Factor from radiance (cd/m²) to the tone curve's input for an exposure, EV.
    static float display_factor(float exposure);

    /// Queues a frame of so many pixels, averaged down from the picture. The pixels' surroundings
    /// and light_vertices() are bound. edges: of the picture; smooths frames of full size once
    /// complete.
    void compose(const GpuScene& scene, const ViewPrograms& programs, PixelAccumulator& pixels,
                 const EdgeFilter& edges, const PictureLook& look, glm::uvec2 frame_size);
    [[nodiscard]] bool finished() const { return readback_->ready(); }
    /// RGBA bytes, row 0 at the top; valid until the next compose().
    std::span<const std::uint8_t> take() { return readback_->take_as<std::uint8_t>(); }

    /// Queues depths on a grid with so many columns; see DepthGrid.
    void request_depths(const ShaderProgram& program, const Texture2D& depths, glm::uvec2 picture,
                        std::uint32_t columns, float near);
    /// Of the depths that were requested last; null before.
    [[nodiscard]] DepthGrid* depths() { return depths_ ? &*depths_ : nullptr; }
    [[nodiscard]] std::size_t bytes() const {
        return frame_.bytes() + (depths_ ? depths_->bytes() : 0);
    }

  private:
    Buffer frame_;
    std::optional<Readback> readback_;  // always
    std::optional<DepthGrid> depths_;   // only for who asks for depths
};

}  // namespace raybundle
