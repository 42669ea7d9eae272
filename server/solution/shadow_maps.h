// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "solution/gpu_scene.h"

namespace raybundle {

/// What each punctual light sees of the scene: numbers of the nearest surfaces, a cube of six faces
/// round a point light, one face for a spot and for a directional light. shaders/first_shot.glsl
/// reads them.
class ShadowMaps {
  public:
    explicit ShadowMaps(const GpuScene& scene);

    /// Draws all maps for the present place of the objects. Returns the lights as shaders want
    /// them; valid until the next call.
    std::span<const layout::PunctualData> draw();
    void bind() const { glBindTextureUnit(UNIT_SHADOW_MAPS, maps_.get()); }
    /// The lights' profiles, each once, in the order of PunctualData::profile.
    [[nodiscard]] const std::vector<std::shared_ptr<const IesProfile>>& profiles() const {
        return profiles_;
    }
    [[nodiscard]] std::size_t bytes() const;

  private:
    void place_lights();
    [[nodiscard]] unsigned profile_of(std::size_t light) const;
    void draw_layer(unsigned layer, const glm::mat4& clip_from_world);
    [[nodiscard]] glm::mat4 clip_from_world(const layout::PunctualData& light, unsigned face) const;

    const GpuScene& scene_;
    std::vector<layout::PunctualData> lights_;
    std::vector<std::shared_ptr<const IesProfile>> profiles_;
    unsigned layers_ = 0;
    int size_ = 0;  // texels along an edge
    Texture2D maps_, depths_;
    Framebuffer framebuffer_;
    ShaderProgram raster_;
};

}  // namespace raybundle
