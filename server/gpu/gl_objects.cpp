// SPDX-License-Identifier: Apache-2.0
#include "gpu/gl_objects.h"

#include <algorithm>

#include "gpu/egl_context.h"
#include "gpu/gl_limits.h"

namespace raybundle {

void delete_buffer(GLuint name) {
    glDeleteBuffers(1, &name);
}
void delete_texture(GLuint name) {
    glDeleteTextures(1, &name);
}
void delete_framebuffer(GLuint name) {
    glDeleteFramebuffers(1, &name);
}
void delete_vertex_array(GLuint name) {
    glDeleteVertexArrays(1, &name);
}
void delete_program(GLuint name) {
    glDeleteProgram(name);
}
void delete_query(GLuint name) {
    glDeleteQueries(1, &name);
}

namespace {

/// Out of memory is the one GL error that is the machine's, not the program's: say what did not
/// fit. An error is the first one since the last check, so any other belongs to what was before.
void check_memory(const std::string& label, std::size_t bytes) {
    const GLenum error = glGetError();
    if (error == GL_OUT_OF_MEMORY) {
        throw GpuError("out of GPU memory: " + label + " needs " +
                       std::to_string(bytes / (1024 * 1024)) +
                       " MiB; use a larger --patch-size or fewer viewers");
    }
    throw_gl_error(error, "making '" + label + "' or before");
}

std::size_t texel_bytes(GLenum format) {
    switch (format) {
        case GL_R32UI:
        case GL_R32F:
            return 4;
        case GL_RG32F:
        case GL_RG32UI:
        case GL_RGBA16F:
            return 8;
        default:  // four numbers of 32 bits
            return 16;
    }
}

}  // namespace

Buffer::Buffer(const std::string& label, std::size_t bytes, GLbitfield flags)
    : bytes_(std::max<std::size_t>(bytes, 16)) {
    check_storage(label, bytes_);
    GLuint name = 0;
    glCreateBuffers(1, &name);
    name_ = GlName<delete_buffer>(name);
    glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes_), nullptr, flags);
    glObjectLabel(GL_BUFFER, name, -1, label.c_str());
    check_memory(label, bytes_);
}

Buffer Buffer::mapped(const std::string& label, std::size_t bytes) {
    constexpr GLbitfield access = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    Buffer result(label, bytes, access);
    result.data_ =
        glMapNamedBufferRange(result.get(), 0, static_cast<GLsizeiptr>(result.bytes_), access);
    if (result.data_ == nullptr) {
        throw_gl_error(glGetError(), "mapping '" + label + "'");
    }
    return result;
}

void finish_commands() {
    GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, GL_TIMEOUT_IGNORED);
    glDeleteSync(fence);
}

void Buffer::upload(const void* data, std::size_t bytes, std::size_t offset) const {
    if (bytes > 0) {
        glNamedBufferSubData(get(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes),
                             data);
    }
}

void Buffer::download(void* data, std::size_t bytes, std::size_t offset) const {
    if (bytes > 0) {
        glGetNamedBufferSubData(get(), static_cast<GLintptr>(offset),
                                static_cast<GLsizeiptr>(bytes), data);
    }
}

void Buffer::clear(std::size_t bytes) const {
    glClearNamedBufferSubData(get(), GL_R32UI, 0, static_cast<GLsizeiptr>(bytes), GL_RED_INTEGER,
                              GL_UNSIGNED_INT, nullptr);
}

void Buffer::bind_storage(GLuint binding) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, get());
}

void Buffer::bind_uniform(GLuint binding) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, binding, get());
}

Texture2D create_texture_2d(const std::string& label, GLenum format, int width, int height) {
    check_texture_2d(label, width, height);
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D, 1, &name);
    Texture2D texture(name);
    glTextureStorage2D(name, 1, format, width, height);
    glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glObjectLabel(GL_TEXTURE, name, -1, label.c_str());
    check_memory(label, static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
    return texture;
}

Texture2D create_buffer_texture(const std::string& label, GLenum format, const Buffer& buffer) {
    check_buffer_texture(label, buffer.bytes(), texel_bytes(format));
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &name);
    Texture2D texture(name);
    glTextureBuffer(name, format, buffer.get());
    glObjectLabel(GL_TEXTURE, name, -1, label.c_str());
    return texture;
}

Framebuffer create_framebuffer(const std::string& label, GLuint colour, GLuint depth) {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    Framebuffer framebuffer(name);
    if (colour != 0) {
        glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, colour, 0);
    }
    if (depth != 0) {
        glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth, 0);
    }
    const GLenum status = glCheckNamedFramebufferStatus(name, GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE) {
        throw GpuError("framebuffer '" + label + "' is incomplete, status " +
                       std::to_string(status));
    }
    glObjectLabel(GL_FRAMEBUFFER, name, -1, label.c_str());
    return framebuffer;
}

}  // namespace raybundle
