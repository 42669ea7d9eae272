// SPDX-License-Identifier: Apache-2.0
#include "solution/geometry/texture_levels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <utility>

#include "scene/material/texture_mean.h"

namespace raybundle {
namespace {

/// Linear light, and alpha.
struct Level {
    int width = 0, height = 0;
    std::vector<glm::vec4> texels;
};

// IEC 61966-2-1.
std::uint32_t srgb_byte(float linear) {
    const float encoded =
        linear <= 0.0031308F ? 12.92F * linear : 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
    return static_cast<std::uint32_t>(std::clamp(encoded, 0.0F, 1.0F) * 255.0F + 0.5F);
}

std::uint32_t packed(const glm::vec4& texel) {
    return srgb_byte(texel.r) | srgb_byte(texel.g) << 8U | srgb_byte(texel.b) << 16U |
           static_cast<std::uint32_t>(std::clamp(texel.a, 0.0F, 1.0F) * 255.0F + 0.5F) << 24U;
}

Level linear_level(const Texture& texture) {
    Level level{texture.width, texture.height, {}};
    level.texels.reserve(texture.rgba.size() / 4);
    for (std::size_t i = 0; i + 3 < texture.rgba.size(); i += 4) {
        level.texels.emplace_back(linear_from_srgb(texture.rgba[i]),
                                  linear_from_srgb(texture.rgba[i + 1]),
                                  linear_from_srgb(texture.rgba[i + 2]),
                                  static_cast<float>(texture.rgba[i + 3]) / 255.0F);
    }
    return level;
}

/// Mean of `size` texels, `stride` apart, over the i-th of `halves` equal parts of their length.
glm::vec4 mean_of_part(const glm::vec4* texels, std::size_t stride, int size, int i, int halves) {
    const float width = static_cast<float>(size) / static_cast<float>(halves);
    const float from = static_cast<float>(i) * width;
    const float to = from + width;
    glm::vec4 sum(0.0F);
    for (int k = static_cast<int>(from); k < size && static_cast<float>(k) < to; ++k) {
        const float share =
            std::min(to, static_cast<float>(k + 1)) - std::max(from, static_cast<float>(k));
        sum += std::max(share, 0.0F) * texels[static_cast<std::size_t>(k) * stride];
    }
    return sum / width;
}

Level halved(const Level& level) {
    const int width = std::max(level.width / 2, 1);
    const int height = std::max(level.height / 2, 1);
    Level rows{width, level.height, {}};
    for (int y = 0; y < level.height; ++y) {
        const glm::vec4* row =
            &level.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width)];
        for (int x = 0; x < width; ++x) {
            rows.texels.push_back(mean_of_part(row, 1, level.width, x, width));
        }
    }
    Level half{width, height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            half.texels.push_back(mean_of_part(&rows.texels[static_cast<std::size_t>(x)],
                                               static_cast<std::size_t>(width), level.height, y,
                                               height));
        }
    }
    return half;
}

}  // namespace

void append_texels(const Texture& texture, std::vector<std::uint32_t>& texels) {
    for (std::size_t i = 0; i + 3 < texture.rgba.size(); i += 4) {
        texels.push_back(static_cast<std::uint32_t>(texture.rgba[i]) |
                         static_cast<std::uint32_t>(texture.rgba[i + 1]) << 8U |
                         static_cast<std::uint32_t>(texture.rgba[i + 2]) << 16U |
                         static_cast<std::uint32_t>(texture.rgba[i + 3]) << 24U);
    }
}

void append_colour_levels(const Texture& texture, std::vector<std::uint32_t>& texels) {
    append_texels(texture, texels);
    if (texture.width <= 0 || texture.height <= 0) {
        return;
    }
    Level level = linear_level(texture);
    while (level.width > 1 || level.height > 1) {
        level = halved(level);
        for (const glm::vec4& texel : level.texels) {
            texels.push_back(packed(texel));
        }
    }
}

}  // namespace raybundle
