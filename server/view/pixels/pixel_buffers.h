// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>

#include "bundle/bundle_frame.h"
#include "gpu/gl_objects.h"
#include "solution/geometry/reflectance_tables.h"

namespace raybundle {

inline std::size_t pixel_count(glm::uvec2 size) {
    return std::size_t{size.x} * size.y;
}

/// What each pixel of a picture has: the surface it shows and the light it has gathered, now and in
/// the picture before, which a new picture takes it over from. Written by shaders alone.
class PixelBuffers {
  public:
    /// Surfaces and the light that they have gathered.
    struct Picture {
        Picture() = default;
        Picture(glm::uvec2 size, const ReflectanceTables& reflectance);

        Buffer surfaces;    ///< PixelSurface[]
        Buffer irradiance;  ///< vec4[]: sum, radiance units, and weight beyond the common one
        Buffer gloss;       ///< likewise of lobes; only where some surface is glossy
        Texture2D surface_texture, irradiance_texture, gloss_texture;
    };

    PixelBuffers(glm::uvec2 size, const ReflectanceTables& reflectance);

    [[nodiscard]] bool glossy() const { return gloss_increments_.bytes() > 0; }
    void bind() const;
    /// The picture before, as view_resolve.comp reads it.
    void bind_before() const;
    /// The present picture becomes the one before.
    void swap() { std::swap(now_, before_); }
    /// The present picture and its scatter, of fewer pixels maybe; it has others from now on.
    [[nodiscard]] Picture exchange(Picture picture) {
        std::swap(now_, picture);
        return picture;
    }
    void set_before(Picture picture) { before_ = std::move(picture); }
    /// What the rows of a rectangle show becomes what they showed before. columns: of the picture.
    void copy_rows(const PixelRectangle& rectangle, std::size_t columns) const;

    /// Of the running special phase.
    void clear_increments() const;
    /// The sums of the scatter of samples at probe pixels.
    [[nodiscard]] Buffer& scatter() { return scatter_; }
    /// What rays from lobes have brought so far. pixels: of the picture.
    void clear_lobes(std::size_t pixels) const;
    /// Binds what the pixels have kept over the last change in the place of the increments.
    void bind_kept() const;
    [[nodiscard]] const Buffer& irradiance() const { return now_.irradiance; }
    [[nodiscard]] const Buffer& kept() const { return kept_; }
    [[nodiscard]] std::size_t bytes() const;

  private:
    Picture now_, before_;
    Buffer increments_, gloss_increments_;  // of the running special phase
    Buffer kept_;                           // over the last change, see view_keep.comp
    Texture2D kept_texture_;
    Buffer scatter_;  // of samples, at probe pixels
};

}  // namespace raybundle
