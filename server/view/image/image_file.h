// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

namespace raybundle {

/// Writes linear radiance (cd/m², row 0 at the top) as EXR, channels R, G, B. The file appears
/// whole or not at all. Throws std::runtime_error naming the path and the reason.
void write_exr(const std::string& path, int width, int height, std::span<const glm::vec4> radiance);

/// The bytes of such a file. Throws std::runtime_error.
std::string exr_bytes(int width, int height, std::span<const glm::vec4> radiance);

/// Writes an 8-bit picture as PNG, likewise. rgba: 4 bytes a pixel, row 0 at the top.
void write_png(const std::string& path, int width, int height, std::span<const std::uint8_t> rgba);

/// Linear radiance as write_exr() has written it.
struct LinearPicture {
    int width = 0;
    int height = 0;
    std::vector<glm::vec3> radiance;  ///< cd/m², row 0 at the top
};

/// Reads the first three channels of an EXR file. Throws std::runtime_error naming the path and the
/// reason.
LinearPicture read_exr(const std::string& path);

}  // namespace raybundle
