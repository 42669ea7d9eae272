// SPDX-License-Identifier: Apache-2.0
#include "bundle/traced_picture.h"

#include <bit>

namespace raybundle {

TracedPicture::TracedPicture(int width, int height, bool depths)
    : width_(width),
      surfaces_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
      depths_(depths ? surfaces_.size() : 0) {}

FacetTracer::Nearest TracedPicture::result(float depth_scale) {
    return {surfaces_.data(), depths_.empty() ? nullptr : depths_.data(), depth_scale};
}

void TracedPicture::upload(const PixelRectangle& rectangle, const Texture2D& surfaces,
                           const Texture2D* depths) const {
    if (rectangle.empty()) {
        return;
    }
    const std::size_t first =
        static_cast<std::size_t>(rectangle.y0) * static_cast<std::size_t>(width_) +
        static_cast<std::size_t>(rectangle.x0);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, width_);
    glTextureSubImage2D(surfaces.get(), 0, rectangle.x0, rectangle.y0, rectangle.width(),
                        rectangle.height(), GL_RED_INTEGER, GL_UNSIGNED_INT, &surfaces_[first]);
    if (depths != nullptr) {
        glTextureSubImage2D(depths->get(), 0, rectangle.x0, rectangle.y0, rectangle.width(),
                            rectangle.height(), GL_RED, GL_FLOAT, &depths_[first]);
    }
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

std::uint32_t bundle_number(const BundleFrame& frame) {
    return std::bit_cast<std::uint32_t>(frame.origin.x) ^ std::bit_cast<std::uint32_t>(frame.x.y);
}

}  // namespace raybundle
