// SPDX-License-Identifier: Apache-2.0
#include "view/tiles/picture_tiles.h"

#include <algorithm>
#include <cmath>

namespace raybundle {

PictureTiles::PictureTiles(glm::uvec2 size, Content content, unsigned edge, std::size_t most)
    : size_(glm::max(size, glm::uvec2(1))), content_(content), edge_(0) {
    if (std::size_t{size_.x} * size_.y > most) {
        edge_ = std::max(edge, 1U);
        columns_ = (size_.x + edge_ - 1) / edge_;
        rows_ = (size_.y + edge_ - 1) / edge_;
    }
}

PictureTiles::Area PictureTiles::tile() const {
    if (edge_ == 0) {
        return {glm::uvec2(0), size_};
    }
    const glm::uvec2 place(static_cast<unsigned>(next_ % columns_),
                           static_cast<unsigned>(next_ / columns_));
    const glm::uvec2 corner = place * edge_;
    return {corner, glm::min(glm::uvec2(edge_), size_ - corner)};
}

PictureTiles::Area PictureTiles::drawn() const {
    const Area inner = tile();
    if (edge_ == 0) {
        return inner;
    }
    const glm::uvec2 low = inner.corner - glm::min(inner.corner, glm::uvec2(margin));
    const glm::uvec2 high = glm::min(inner.corner + inner.size + margin, size_);
    return {low, high - low};
}

Camera PictureTiles::drawn_camera(const Camera& whole) const {
    const Area area = drawn();
    const glm::vec2 share = glm::vec2(area.size) / glm::vec2(size_);
    const glm::vec2 centre =
        (2.0F * glm::vec2(area.corner) + glm::vec2(area.size)) / glm::vec2(size_) - 1.0F;
    Camera camera = whole;
    camera.part = {centre.x, -centre.y, share};
    return camera;
}

template <typename Element>
void PictureTiles::copy(const std::vector<Element>& from, unsigned per_pixel,
                        std::vector<Element>& to) const {
    to.resize(std::size_t{size_.x} * size_.y * per_pixel);
    const Area inner = tile();
    const Area area = drawn();
    const glm::uvec2 skipped = inner.corner - area.corner;
    for (unsigned row = 0; row < inner.size.y; ++row) {
        const std::size_t source = std::size_t{row + skipped.y} * area.size.x + skipped.x;
        const std::size_t target = std::size_t{inner.corner.y + row} * size_.x + inner.corner.x;
        std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(source * per_pixel),
                    std::size_t{inner.size.x} * per_pixel,
                    to.begin() + static_cast<std::ptrdiff_t>(target * per_pixel));
    }
}

void PictureTiles::take(ViewerImage& image, const PictureLook& look) {
    if (content_ == Content::radiance) {
        copy(image.read_radiance(), 1, radiance_);
    } else {
        image.compose(look.mode, look.exposure, image.size(), look.scale);
        const std::span<const std::uint8_t> bytes = image.take();
        copy(std::vector<std::uint8_t>(bytes.begin(), bytes.end()), 4, display_);
    }
    const ImageStatistics& statistics = image.statistics();
    const Area inner = tile();
    const double light = static_cast<double>(inner.size.x) * inner.size.y *
                         statistics.rms_luminance * statistics.rms_luminance;
    squared_light_ += light;
    squared_error_ += light * statistics.error_high * statistics.error_high;
    only_error_ = statistics.error_high;
    ++next_;
}

double PictureTiles::error_high() const {
    return count() > 1 && squared_light_ > 0.0 ? std::sqrt(squared_error_ / squared_light_)
                                               : only_error_;
}

}  // namespace raybundle
