// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/shader_program.h"

namespace raybundle {

/// The pixels of a viewer that other surfaces are near to, listed on the GPU; see
/// view_crowded.comp. What a bundle's window shows them of those is too coarse: they follow their
/// own rays.
class CrowdedPixels {
  public:
    /// capacity: pixels.
    explicit CrowdedPixels(std::size_t capacity);

    /// All pixels are new.
    void begin();
    /// Pixels or what is near them have changed: to be marked again.
    void restart() { marked_ = 0; }
    /// Marks so many more of `pixels` at most, for windows with pixels of this size, m. They are
    /// bound. tie: m, surfaces that are nearer to each other coincide.
    void mark(const ShaderProgram& program, std::size_t pixels, std::size_t most,
              float window_pixel, float tie);
    /// Runs a program of local size CROWDED_GROUP on all that are marked. window_pixel: m, of the
    /// running window, which may be another than they are marked for.
    void dispatch(const ShaderProgram& program, float window_pixel) const;
    [[nodiscard]] std::size_t bytes() const { return list_.bytes(); }

  private:
    Buffer list_;
    std::size_t marked_ = 0;     // pixels that have been looked at
    bool any_ = false;           // some may be listed
    float window_pixel_ = 0.0F;  // m, that they are marked for
};

}  // namespace raybundle
