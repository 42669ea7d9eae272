// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "bundle/bundle_frame.h"
#include "gpu/gl_objects.h"
#include "gpu/layouts.h"

namespace raybundle {

/// A camera and what all pixels of its picture have in common, as shaders see it.
class PictureView {
  public:
    PictureView() : block_("view parameters", sizeof(layout::ViewParameters)) {}

    /// What upload() sends.
    layout::ViewParameters values{};
    float vertical_fov = 0.0F;  ///< of the camera, radians

    void upload();
    void bind() const { block_.bind_uniform(BINDING_VIEW); }
    [[nodiscard]] std::size_t bytes() const { return block_.bytes(); }

  private:
    Buffer block_;
};

PixelRectangle whole_picture(const layout::ViewParameters& view);

/// Smallest rectangle that holds what some boxes (shifted world) hold: with whole work groups of
/// view_resolve.comp, and rounding. Empty where nothing of them is in the picture.
PixelRectangle rectangle_of(std::span<const Bounds> boxes, const layout::ViewParameters& view);

}  // namespace raybundle
