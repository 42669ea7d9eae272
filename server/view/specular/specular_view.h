// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>

#include "gpu/gl_objects.h"
#include "view/pixels/pixel_accumulator.h"
#include "view/specular/continued_ends.h"

namespace raybundle {

/// What a picture shows in mirrors and through glass: pixels at the ends of its view rays. They
/// receive all bundles like any others, so that what is seen in a mirror is as exact as what is
/// seen without. There are as many as it takes; see continued.glsl.
class SpecularView {
  public:
    SpecularView(const GpuScene& scene, const RadianceStore& store, const ViewPrograms& programs);

    /// Follows the view rays of a picture as it is now. Ends that are where they were keep what
    /// they have received, with this share of their weight; all others begin anew. near: distance
    /// of the picture's plane, m. Binds buffers.
    void refresh(const layout::ViewParameters& view, const Camera& camera, float near,
                 float kept_weight);
    /// The pixels at the ends; null while the picture shows none.
    [[nodiscard]] PixelAccumulator* pixels() { return pixels_ ? &*pixels_ : nullptr; }
    /// Finds the radiance that the pixels show. Binds buffers.
    void shade();
    /// What shaders of the picture need.
    void bind() const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    void choose_size(unsigned columns, unsigned rows);

    const GpuScene& scene_;
    const RadianceStore& store_;
    const ViewPrograms& programs_;
    ContinuedEnds found_;
    unsigned columns_ = 1, rows_ = 0;  // of tiles
    Buffer tiles_, ends_, radiance_;
    std::optional<PixelAccumulator> pixels_;
};

}  // namespace raybundle
