// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "solution/direct/map_touch.h"
#include "solution/direct/placed_lights.h"
#include "solution/geometry/gpu_scene.h"

namespace raybundle {

/// What each punctual light sees of the scene: numbers of the nearest surfaces, a cube of six faces
/// round a point light, one face for a spot and for a directional light; and near which of their
/// texels some surface begins or ends. shaders/solution/first_shot.glsl reads them.
class ShadowMaps {
  public:
    explicit ShadowMaps(const GpuScene& scene);

    /// The scene's lights with their maps, as shaders want them.
    [[nodiscard]] std::vector<layout::PunctualData> placed(const IesProfiles& profiles) const;
    /// Texels whose surfaces may be others for what is in a box (shifted world), or will be.
    [[nodiscard]] MapTexels showing(const layout::PunctualData& light, unsigned face,
                                    const Bounds& box) const;
    /// Draws what is touched of the lights' maps, for the present place of the objects.
    void draw(std::span<const layout::PunctualData> lights);
    void bind() const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    /// A part of a layer.
    struct Part {
        unsigned layer = 0;
        glm::mat4 clip_from_world{1.0F};  ///< of the whole layer
        glm::mat4 seen{1.0F};             ///< of the part alone
    };
    void draw_part(const Part& part);
    void mark_edges(const Part& part);
    [[nodiscard]] glm::mat4 clip_from_world(const layout::PunctualData& light, unsigned face) const;

    const GpuScene& scene_;
    unsigned layers_ = 0;
    int size_ = 0;  // texels along an edge
    Texture2D maps_, depths_, edges_;
    Framebuffer framebuffer_, edge_framebuffer_;
    ShaderProgram raster_, edge_raster_;
    std::optional<ShaderProgram> cut_out_raster_;  // only where alpha cuts some surfaces
};

}  // namespace raybundle
