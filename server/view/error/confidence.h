// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "gpu/gl_objects.h"
#include "gpu/layouts.h"
#include "gpu/shader_program.h"

namespace raybundle {

struct ConfidencePrograms {
    ShaderProgram look, evaluate;
};

/// How much a picture's pixels believe their own samples beside the light of the patches
/// (shaders/view/confidence/view_confidence.glsl): measured in tiles each time that there are twice
/// as many samples. Costs nothing in between.
class Confidence {
  public:
    explicit Confidence(glm::uvec2 size);

    /// Nothing is known.
    void forget();
    /// Takes over what another one knows of its whole picture.
    void inherit(const Confidence& other) const;
    /// Takes over its tiles, too, of a picture with so many times fewer pixels along each edge.
    void inherit_tiles(const Confidence& other, unsigned factor);
    /// The pixels show something else, or have other samples: what is known of the whole picture
    /// counts, and no longer that of its tiles.
    void restart();

    /// Whether it wants to look at a picture with so many samples.
    [[nodiscard]] bool due(std::uint64_t samples) const { return samples >= next_; }
    /// Looks at the pixels of a picture, which are bound, with the vertices' light.
    void look(const ConfidencePrograms& programs, glm::uvec2 size, std::uint32_t triangle_count,
              std::uint64_t samples);
    void bind() const;
    /// Tiles along both edges, 0 while nothing is known of them, and the pixels along a tile's
    /// edge.
    [[nodiscard]] glm::vec3 tiles() const { return {tiles_, tile_}; }
    /// Since the pixels were new.
    [[nodiscard]] bool has_looked() const { return tiles_.x > 0; }
    [[nodiscard]] std::size_t bytes() const { return sums_.bytes() + light_.bytes(); }

  private:
    static constexpr std::uint64_t first_look = GROUP_SIZE;  // samples

    Buffer sums_, light_;
    Texture2D texture_;
    std::uint64_t next_ = first_look;
    glm::uvec2 tiles_{0};
    std::uint32_t tile_ = CONFIDENCE_TILE;
};

}  // namespace raybundle
