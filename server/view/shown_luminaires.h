// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "solution/direct/first_shot.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {

/// Bodies of luminaires (scene/photometry/luminaire_body.h) that a picture shows, of the lights as
/// they are now: what is moved, dimmed or removed shows in the next picture that is made. Of more
/// than MOST_LUMINAIRES the nearest to the eye.
class ShownLuminaires {
  public:
    ShownLuminaires();

    /// Whether the shaders of a scene know of any.
    static bool possible(const GpuScene& scene);

    struct Look {
        const Camera& camera;
        float near = 0.0F;           ///< distance of the picture's plane, m
        unsigned rays_per_edge = 1;  ///< of a pixel
    };
    void update(const GpuScene& scene, const FirstShot& shot, const Look& look);
    void bind() const { buffer_.bind_storage(BINDING_LUMINAIRES); }
    /// So many are shown.
    [[nodiscard]] std::size_t size() const { return luminaires_.size(); }
    [[nodiscard]] std::size_t bytes() const { return buffer_.bytes(); }

  private:
    layout::LuminaireHead head_{};
    std::vector<layout::LuminaireData> luminaires_;
    Buffer buffer_;
};

}  // namespace raybundle
