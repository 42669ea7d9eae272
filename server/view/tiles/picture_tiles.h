// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "view/viewer_image.h"

namespace raybundle {

/// A picture that is made one tile after the other where it is large, so that what the GPU holds of
/// it is bounded: each is a ViewerImage of a part of the camera's picture, with a margin on all
/// sides, by which edges are as smooth along the seams as elsewhere.
class PictureTiles {
  public:
    static constexpr std::size_t most_pixels = 3840UL * 2160UL;  ///< drawn at once
    static constexpr unsigned most_edge = 8192;                  ///< pixels
    static constexpr unsigned margin = 8;                        ///< pixels
    enum class Content { radiance, display };

    /// edge: of the tiles of a picture that is larger than `most`, pixels.
    PictureTiles(glm::uvec2 size, Content content, unsigned edge = 2048,
                 std::size_t most = most_pixels);

    [[nodiscard]] std::size_t count() const { return std::size_t{columns_} * rows_; }
    [[nodiscard]] std::size_t done() const { return next_; }
    [[nodiscard]] bool complete() const { return next_ == count(); }
    [[nodiscard]] glm::uvec2 size() const { return size_; }

    /// Of the ViewerImage that draws the next tile.
    [[nodiscard]] glm::uvec2 drawn_size() const { return drawn().size; }
    [[nodiscard]] Camera drawn_camera(const Camera& whole) const;
    /// Takes the next tile from its image, whose statistics are known. look: of Content::display.
    /// Synchronous. Throws GpuError.
    void take(ViewerImage& image, const PictureLook& look);

    /// Upper end of the interval of the relRMSE of all tiles taken so far.
    [[nodiscard]] double error_high() const;
    /// Row 0 at the top; linear, cd/m², or RGBA bytes. Empty where it is the other content.
    [[nodiscard]] std::vector<glm::vec4> take_radiance() { return std::move(radiance_); }
    [[nodiscard]] std::vector<std::uint8_t> take_display() { return std::move(display_); }

  private:
    /// Rectangle of pixels, row 0 at the top.
    struct Area {
        glm::uvec2 corner{0}, size{0};
    };
    [[nodiscard]] Area tile() const;   ///< the next one
    [[nodiscard]] Area drawn() const;  ///< with its margin
    template <typename Element>
    void copy(const std::vector<Element>& from, unsigned per_pixel, std::vector<Element>& to) const;

    glm::uvec2 size_;
    Content content_;
    unsigned edge_;  // 0: one tile
    unsigned columns_ = 1, rows_ = 1;
    std::size_t next_ = 0;
    double squared_error_ = 0.0, squared_light_ = 0.0;  // sums over pixels, (cd/m²)²
    double only_error_ = 1.0;
    std::vector<glm::vec4> radiance_;
    std::vector<std::uint8_t> display_;
};

}  // namespace raybundle
