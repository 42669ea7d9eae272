// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bundle/bundle_frame.h"
#include "bundle/traced_picture.h"
#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/shader_program.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {

/// A perspective bundle: the surfaces that a point sees (ch. 5.1.2). Five faces of surface ids and
/// depths are stacked in one picture; see shaders/bundle/hemicube.glsl for its geometry.
class Hemicube {
  public:
    static constexpr int face_count = 5;
    using FaceRectangles = std::array<PixelRectangle, face_count>;

    /// n: pixels along the top face, rounded up to a multiple of 16. defines: of the scene to be
    /// drawn, see GpuScene::defines(). traced: by rays, where the scene has a tracer.
    explicit Hemicube(int n, const std::vector<std::string>& defines = {}, bool traced = false);

    [[nodiscard]] int size() const { return n_; }
    [[nodiscard]] FaceRectangles full() const;
    /// Per face the pixels that can see any of the boxes; all of them where the origin is inside
    /// one or the projection is unbounded.
    [[nodiscard]] FaceRectangles covering(const BundleFrame& frame,
                                          std::span<const Bounds> boxes) const;

    /// Finds the surfaces of the scene at a place, in the given rectangles only.
    void draw(const GpuScene& scene, const BundleFrame& frame, float near_distance, Place place,
              const FaceRectangles& rectangles);
    void bind_textures() const;  ///< units 0: surface ids, 1: depths
    [[nodiscard]] const Texture2D& surface_ids() const { return surface_ids_; }
    /// First row of a face in the stacked picture.
    [[nodiscard]] int first_row(int face) const { return face == 0 ? 0 : n_ + (face - 1) * n_ / 2; }
    [[nodiscard]] std::size_t bytes() const;

  private:
    [[nodiscard]] int face_rows(int face) const { return face == 0 ? n_ : n_ / 2; }
    void raster(const GpuScene& scene, const BundleFrame& frame, float near_distance, Place place,
                const FaceRectangles& rectangles) const;
    [[nodiscard]] RayGrid rays(const BundleFrame& frame, int face, float near_distance,
                               const PixelRectangle& rectangle) const;
    void trace(const GpuScene& scene, const BundleFrame& frame, float near_distance, Place place,
               const FaceRectangles& rectangles);

    int n_;
    std::optional<TracedPicture> traced_;
    Texture2D surface_ids_, depths_;
    Framebuffer framebuffer_;
    ShaderProgram raster_;
};

}  // namespace raybundle
