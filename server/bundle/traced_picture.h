// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bundle/bundle_frame.h"
#include "gpu/gl_objects.h"
#include "trace/facet_tracer.h"

namespace raybundle {

/// The surfaces, and depths, of a picture in this program's memory, on their way to textures.
class TracedPicture {
  public:
    TracedPicture(int width, int height, bool depths);

    /// Receives the hits of rays.
    [[nodiscard]] FacetTracer::Nearest result(float depth_scale);
    /// Copies a rectangle to textures of the picture's size, R32UI and R32F.
    void upload(const PixelRectangle& rectangle, const Texture2D& surfaces,
                const Texture2D* depths) const;
    [[nodiscard]] std::size_t width() const { return static_cast<std::size_t>(width_); }

  private:
    int width_;
    std::vector<std::uint32_t> surfaces_;
    std::vector<float> depths_;
};

/// Random number of a bundle, as shaders/material/glass.glsl makes it.
std::uint32_t bundle_number(const BundleFrame& frame);

}  // namespace raybundle
