// SPDX-License-Identifier: Apache-2.0
#include "scene/material/texture_mean.h"

#include <algorithm>
#include <cmath>

namespace raybundle {
namespace {

constexpr int min_samples = 64;
// More would cost time that the remaining error (below 1 % of the texture's contrast) is not worth.
constexpr int max_samples = 256;

std::array<float, 256> srgb_table() {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const float x = static_cast<float>(i) / 255.0F;
        table[i] = x <= 0.04045F ? x / 12.92F : std::pow((x + 0.055F) / 1.055F, 2.4F);
    }
    return table;
}

/// Texel index along one axis for a texture coordinate.
int texel_index(float coordinate, int size, bool repeat) {
    const float wrapped = repeat ? coordinate - std::floor(coordinate) : coordinate;
    // Also turns NaN, from coordinates that overflowed, into 0.
    const float inside = wrapped >= 0.0F ? std::min(wrapped, 1.0F) : 0.0F;
    return std::min(static_cast<int>(inside * static_cast<float>(size)), size - 1);
}

/// What the bytes of a texture stand for.
using Decode = float (*)(std::uint8_t);

float linear_from_data(std::uint8_t value) {
    return static_cast<float>(value) / 255.0F;
}

class TriangleSampler {
  public:
    TriangleSampler(const Texture& texture, Decode decode, const glm::mat3& uv_from_mesh_uv,
                    const std::array<glm::vec2, 3>& mesh_uv, std::optional<float> alpha_cutoff)
        : texture_(texture), decode_(decode), alpha_cutoff_(alpha_cutoff) {
        for (std::size_t k = 0; k < 3; ++k) {
            uv_[k] = glm::vec2(uv_from_mesh_uv * glm::vec3(mesh_uv[k], 1.0F));
        }
    }

    /// Samples by the R2 sequence (Roberts, "The unreasonable effectiveness of quasirandom
    /// sequences", 2018): its irrational steps do not fall in with textures that repeat.
    TextureMean mean() {
        const int count = sample_count();
        double u = 0.5;
        double v = 0.5;
        for (int i = 0; i < count; ++i) {
            u += 0.7548776662466927;
            v += 0.5698402909980532;
            u -= u >= 1.0 ? 1.0 : 0.0;
            v -= v >= 1.0 ? 1.0 : 0.0;
            // The upper half of the unit square is folded onto the triangle.
            const bool upper = u + v > 1.0;
            sample(static_cast<float>(upper ? 1.0 - u : u),
                   static_cast<float>(upper ? 1.0 - v : v));
        }
        TextureMean result;
        result.coverage = static_cast<float>(covered_) / static_cast<float>(count);
        if (covered_ > 0) {
            result.colour = sum_ / static_cast<float>(covered_);
        }
        return result;
    }

  private:
    /// Four samples a texel.
    [[nodiscard]] int sample_count() const {
        const glm::vec2 size(static_cast<float>(texture_.width),
                             static_cast<float>(texture_.height));
        const glm::vec2 a = (uv_[1] - uv_[0]) * size;
        const glm::vec2 b = (uv_[2] - uv_[0]) * size;
        const float wanted = 2.0F * std::abs(a.x * b.y - a.y * b.x);
        return wanted < static_cast<float>(max_samples)
                   ? std::max(static_cast<int>(wanted), min_samples)
                   : max_samples;
    }

    void sample(float b, float c) {
        const glm::vec2 uv = (1.0F - b - c) * uv_[0] + b * uv_[1] + c * uv_[2];
        const int x = texel_index(uv.x, texture_.width, texture_.repeat_u);
        const int y = texel_index(uv.y, texture_.height, texture_.repeat_v);
        const std::uint8_t* texel =
            texture_.rgba.data() +
            (static_cast<std::size_t>(y) * static_cast<std::size_t>(texture_.width) +
             static_cast<std::size_t>(x)) *
                4;
        if (alpha_cutoff_ && static_cast<float>(texel[3]) / 255.0F < *alpha_cutoff_) {
            return;
        }
        ++covered_;
        sum_ += glm::vec3(decode_(texel[0]), decode_(texel[1]), decode_(texel[2]));
    }

    const Texture& texture_;
    Decode decode_;
    std::optional<float> alpha_cutoff_;
    std::array<glm::vec2, 3> uv_{};
    glm::vec3 sum_{0.0F};
    int covered_ = 0;
};

}  // namespace

float linear_from_srgb(std::uint8_t encoded) {
    static const std::array<float, 256> table = srgb_table();
    return table[encoded];
}

TextureMean texture_mean(const Texture& texture, const glm::mat3& uv_from_mesh_uv,
                         const std::array<glm::vec2, 3>& mesh_uv,
                         std::optional<float> alpha_cutoff) {
    return TriangleSampler(texture, linear_from_srgb, uv_from_mesh_uv, mesh_uv, alpha_cutoff)
        .mean();
}

glm::vec3 texture_data_mean(const Texture& texture, const glm::mat3& uv_from_mesh_uv,
                            const std::array<glm::vec2, 3>& mesh_uv) {
    return TriangleSampler(texture, linear_from_data, uv_from_mesh_uv, mesh_uv, std::nullopt)
        .mean()
        .colour;
}

}  // namespace raybundle
