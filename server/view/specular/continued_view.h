// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <optional>

#include "gpu/gl_objects.h"
#include "view/specular/continued_ends.h"
#include "view/viewer_image.h"

namespace raybundle {

/// What a picture shows in mirrors and through glass: the pixels behind it, at the ends of its view
/// rays. They are receivers of all bundles like any others, so that what is seen in a mirror is as
/// exact as what is seen without. A picture of their own holds them, which is as large as it has to
/// be; see continued.glsl.
class ContinuedView {
  public:
    ContinuedView(const GpuScene& scene, const RadianceStore& store, const ViewPrograms& programs);

    /// Follows the view rays of a picture as it is now. Ends that are where they were keep what
    /// they have received, with this share of their weight; all others begin anew. Binds buffers.
    void refresh(const layout::ViewParameters& view, const Camera& camera, float kept_weight);
    /// The pixels as receivers; null while the picture shows none.
    [[nodiscard]] ViewerImage* image() { return image_ ? &*image_ : nullptr; }
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
    std::optional<ViewerImage> image_;
};

}  // namespace raybundle
