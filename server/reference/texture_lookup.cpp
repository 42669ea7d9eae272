// SPDX-License-Identifier: Apache-2.0
#include "reference/texture_lookup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "scene/material/texture_mean.h"

namespace raybundle {
namespace {

/// Index of a texel along one axis, wrapped or clamped.
std::size_t wrapped(double texel, int size, bool repeat) {
    if (repeat) {
        texel -= std::floor(texel / size) * size;
    }
    return static_cast<std::size_t>(texel > 0.0 ? std::min(texel, size - 1.0) : 0.0);
}

using Encoded = std::array<std::uint8_t, 4>;

glm::dvec4 decoded_colour(const Encoded& t) {
    return {linear_from_srgb(t[0]), linear_from_srgb(t[1]), linear_from_srgb(t[2]),
            static_cast<double>(t[3]) / 255.0};
}

glm::dvec4 data_of(const Encoded& t) {
    return glm::dvec4(t[0], t[1], t[2], t[3]) / 255.0;
}

Encoded texel(const Texture& texture, double x, double y) {
    const std::size_t column = wrapped(x, texture.width, texture.repeat_u);
    const std::size_t row = wrapped(y, texture.height, texture.repeat_v);
    const std::uint8_t* t =
        texture.rgba.data() + 4 * (row * static_cast<std::size_t>(texture.width) + column);
    return {t[0], t[1], t[2], t[3]};
}

/// Bilinear.
template <typename Decode>
glm::dvec4 filtered(const Texture& texture, const glm::mat3& uv_from_mesh_uv,
                    const glm::dvec2& mesh_uv, const Decode& decode) {
    const glm::dvec2 uv(glm::dmat3(uv_from_mesh_uv) * glm::dvec3(mesh_uv, 1.0));
    const glm::dvec2 unbounded = uv * glm::dvec2(texture.width, texture.height) - 0.5;
    const glm::dvec2 at(std::isfinite(unbounded.x) ? unbounded.x : 0.0,
                        std::isfinite(unbounded.y) ? unbounded.y : 0.0);
    const glm::dvec2 corner = glm::floor(at);
    const glm::dvec2 f = at - corner;
    const auto at_texel = [&](double x, double y) {
        return decode(texel(texture, corner.x + x, corner.y + y));
    };
    const glm::dvec4 top = glm::mix(at_texel(0.0, 0.0), at_texel(1.0, 0.0), f.x);
    const glm::dvec4 bottom = glm::mix(at_texel(0.0, 1.0), at_texel(1.0, 1.0), f.x);
    return glm::mix(top, bottom, f.y);
}

}  // namespace

glm::dvec4 look_up(const Texture& texture, const glm::mat3& uv_from_mesh_uv,
                   const glm::dvec2& mesh_uv) {
    return filtered(texture, uv_from_mesh_uv, mesh_uv, decoded_colour);
}

glm::dvec4 look_up_data(const Texture& texture, const glm::mat3& uv_from_mesh_uv,
                        const glm::dvec2& mesh_uv) {
    return filtered(texture, uv_from_mesh_uv, mesh_uv, data_of);
}

}  // namespace raybundle
