// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "solution/air/scattered_light.h"

namespace raybundle {

/// Light that the air between a viewer's eye and what it sees sends to the eye: single paths
/// through the picture's pixels, evenly over them. Of each it keeps the radiance and how much of
/// the light behind the air takes away; their ratio, the radiance that endless air would send, is
/// averaged over so many pixels that its noise is 5 %, and less as paths add up, down to the pixel
/// itself. Times what the air takes away, edges of things stay sharp. Later paths weigh more, since
/// they know surfaces better.
class AirView {
  public:
    static constexpr std::uint32_t batch_paths = 8192;

    /// Shows another view, of `size` pixels; `factor`: of the picture's own along an edge of one.
    /// Nothing is lost where only the factor is another.
    void begin(const layout::ViewParameters& view, glm::uvec2 size, unsigned factor);
    /// Another batch of paths. unit: of radiance, cd/m².
    void refine(const ScatteredLight& light, float unit);
    /// Whether no path has been followed yet.
    [[nodiscard]] bool empty(const ScatteredLight& light) const {
        return paths_ == 0 || changes_ != light.changes();
    }
    void bind() const;
    [[nodiscard]] std::size_t bytes() const;

  private:
    struct Sample {
        std::uint32_t pixel = 0;
        AirEstimate light;
        double opacity = 0.0;
    };
    void restart();
    [[nodiscard]] Sample sample(const AirPaths& air, std::uint64_t number) const;
    void note_scatter(const Sample& sample);
    [[nodiscard]] double relative_variance() const;
    void upload();

    layout::ViewParameters view_{};
    glm::uvec2 size_{0};
    unsigned factor_ = 1;
    float unit_ = 1.0F;               // of radiance, cd/m²
    glm::dvec3 reflected_flux_{0.0};  // of surfaces, by the last batch
    std::uint64_t paths_ = 0, batches_ = 0, changes_ = 0;
    std::uint64_t next_upload_ = 0;  // paths
    std::vector<glm::dvec4> sums_;   // of pixels, weighted: radiance by lamps, cd/m², and opacity
    std::vector<glm::dvec3> by_surfaces_;  // likewise, as a share of all that surfaces reflect
    std::vector<glm::dvec3> scatter_;      // of blocks: number, sum and sum of squares of luminance
    Buffer texels_;
    Texture2D texture_;
};

}  // namespace raybundle
