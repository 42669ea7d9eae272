// SPDX-License-Identifier: Apache-2.0
#include "gpu/gl_limits.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>

#include "gpu/egl_context.h"

namespace raybundle {

namespace {

/// Mesa's llvmpipe states 128 MiB and reaches 2 GiB, with signed offsets: it crashes beyond.
constexpr std::size_t software_storage_bytes = 0x7fffffff;

std::size_t limit_of(GLenum name) {
    GLint64 value = 0;
    glGetInteger64v(name, &value);
    return static_cast<std::size_t>(std::max<GLint64>(value, 0));
}

std::string mebibytes(std::size_t bytes) {
    constexpr std::size_t mebibyte = std::size_t{1} << 20U;
    return std::to_string((bytes + mebibyte - 1) / mebibyte) + " MiB";
}

std::string name_of(GLenum error) {
    switch (error) {
        case GL_INVALID_ENUM:
            return "GL_INVALID_ENUM";
        case GL_INVALID_VALUE:
            return "GL_INVALID_VALUE";
        case GL_INVALID_OPERATION:
            return "GL_INVALID_OPERATION";
        case GL_INVALID_FRAMEBUFFER_OPERATION:
            return "GL_INVALID_FRAMEBUFFER_OPERATION";
        case GL_OUT_OF_MEMORY:
            return "GL_OUT_OF_MEMORY";
        case GL_CONTEXT_LOST:
            return "GL_CONTEXT_LOST";
        default:
            return "error " + std::to_string(error);
    }
}

}  // namespace

glm::uvec2 most_work_groups() {
    glm::ivec2 most(0);
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 0, &most.x);
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, 1, &most.y);
    return glm::max(most, 1);
}

glm::uvec2 folded(std::size_t groups, const glm::uvec2& most, const std::string& label) {
    const std::size_t rows = (groups + most.x - 1) / most.x;
    if (rows > most.y) {
        check_work_groups(most.x, rows, most, label);
    }
    return {static_cast<unsigned>((groups + rows - 1) / rows), static_cast<unsigned>(rows)};
}

void check_work_groups(std::size_t x, std::size_t y, const glm::uvec2& most,
                       const std::string& label) {
    if (x > most.x || y > most.y) {
        throw GpuError(label + " needs " + std::to_string(x) + "x" + std::to_string(y) +
                       " work groups, and the driver takes " + std::to_string(most.x) + "x" +
                       std::to_string(most.y));
    }
}

std::size_t most_storage_bytes() {
    const std::size_t stated = limit_of(GL_MAX_SHADER_STORAGE_BLOCK_SIZE);
    return is_software_renderer() ? std::max(stated, software_storage_bytes) : stated;
}

void check_storage(const std::string& label, std::size_t bytes) {
    const std::size_t most = most_storage_bytes();
    if (bytes > most) {
        throw GpuError(label + " need " + mebibytes(bytes) +
                       " in one buffer, and the driver takes " + mebibytes(most) +
                       "; use a larger --patch-size or a smaller picture");
    }
}

void check_buffer_texture(const std::string& label, std::size_t bytes, std::size_t texel_bytes) {
    const std::size_t texels = bytes / texel_bytes;
    const std::size_t most = limit_of(GL_MAX_TEXTURE_BUFFER_SIZE);
    if (texels > most) {
        throw GpuError(label + " need " + std::to_string(texels) +
                       " texels in one buffer texture, and the driver takes " +
                       std::to_string(most) + "; use a larger --patch-size or a smaller picture");
    }
}

unsigned most_picture_edge() {
    std::array<GLint, 2> viewport{};
    glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    const std::size_t texture = limit_of(GL_MAX_TEXTURE_SIZE);
    return static_cast<unsigned>(std::min<std::size_t>(
        {texture, static_cast<std::size_t>(viewport[0]), static_cast<std::size_t>(viewport[1])}));
}

void check_texture_2d(const std::string& label, int width, int height) {
    const std::size_t most = limit_of(GL_MAX_TEXTURE_SIZE);
    if (static_cast<std::size_t>(std::max(width, height)) > most) {
        throw GpuError(label + " need a texture of " + std::to_string(width) + "x" +
                       std::to_string(height) + ", and the driver takes " + std::to_string(most) +
                       "x" + std::to_string(most));
    }
}

void check_texture_layers(const std::string& label, unsigned layers) {
    const std::size_t most = limit_of(GL_MAX_ARRAY_TEXTURE_LAYERS);
    if (layers > most) {
        throw GpuError(label + " need " + std::to_string(layers) +
                       " layers of a texture, and the driver takes " + std::to_string(most));
    }
}

void throw_gl_error(unsigned error, const std::string& doing) {
    if (error != GL_NO_ERROR) {
        throw GlError("the driver has refused a command (" + name_of(error) + "), " + doing);
    }
}

void check_gl_errors(const std::string& doing) {
    throw_gl_error(glGetError(), doing);
}

}  // namespace raybundle
