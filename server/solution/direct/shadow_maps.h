// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "solution/direct/placed_lights.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {

/// What each punctual light sees of the scene: numbers of the nearest surfaces, a cube of six faces
/// round a point light, one face for a spot and for a directional light; and near which of their
/// texels some surface begins or ends. shaders/solution/first_shot.glsl reads them.
class ShadowMaps {
  public:
    explicit ShadowMaps(const GpuScene& scene);

    /// Draws all maps for the present place of the objects. Returns the lights as shaders want
    /// them; valid until the next call.
    std::span<const layout::PunctualData> draw();
    void bind() const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    void place_lights();
    void draw_layer(unsigned layer, const glm::mat4& clip_from_world);
    void mark_edges(unsigned layer, const glm::mat4& clip_from_world);
    [[nodiscard]] glm::mat4 clip_from_world(const layout::PunctualData& light, unsigned face) const;

    const GpuScene& scene_;
    std::vector<layout::PunctualData> lights_;
    IesProfiles profiles_;
    unsigned layers_ = 0;
    int size_ = 0;  // texels along an edge
    Texture2D maps_, depths_, edges_;
    Framebuffer framebuffer_, edge_framebuffer_;
    ShaderProgram raster_, edge_raster_;
    std::optional<ShaderProgram> cut_out_raster_;  // only where alpha cuts some surfaces
};

}  // namespace raybundle
