// SPDX-License-Identifier: Apache-2.0
// RAII over OpenGL names. All need a current context, for their destruction too.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <span>
#include <string>
#include <utility>

namespace raybundle {

/// Owns one GL name; Deleter is called with it.
template <void (*Deleter)(GLuint)>
class GlName {
  public:
    GlName() = default;
    explicit GlName(GLuint name) : name_(name) {}
    GlName(GlName&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlName& operator=(GlName&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    GlName(const GlName&) = delete;
    GlName& operator=(const GlName&) = delete;
    ~GlName() {
        if (name_ != 0) {
            Deleter(name_);
        }
    }
    [[nodiscard]] GLuint get() const { return name_; }

  private:
    GLuint name_ = 0;
};

void delete_buffer(GLuint name);
void delete_texture(GLuint name);
void delete_framebuffer(GLuint name);
void delete_vertex_array(GLuint name);
void delete_program(GLuint name);
void delete_query(GLuint name);

using Texture2D = GlName<delete_texture>;
using Framebuffer = GlName<delete_framebuffer>;
using VertexArray = GlName<delete_vertex_array>;
using Program = GlName<delete_program>;
using Query = GlName<delete_query>;

/// A buffer object of fixed size. The label shows up in profiles and GL messages.
class Buffer {
  public:
    Buffer() = default;
    /// Uninitialised storage; size 0 is rounded up so that it can be bound. Throws GpuError.
    Buffer(const std::string& label, std::size_t bytes, GLbitfield flags = GL_DYNAMIC_STORAGE_BIT);

    template <typename T>
    static Buffer from(const std::string& label, std::span<const T> values) {
        Buffer result(label, values.size_bytes());
        result.write(values, 0);
        return result;
    }

    /// Storage that this program writes directly, at any time when no command is under way that
    /// reads it.
    static Buffer mapped(const std::string& label, std::size_t bytes);
    /// Of a mapped one.
    template <typename T>
    [[nodiscard]] T* data() const {
        return static_cast<T*>(data_);
    }

    template <typename T>
    void write(std::span<const T> values, std::size_t byte_offset) {
        upload(values.data(), values.size_bytes(), byte_offset);
    }

    /// Synchronous; for loading, tests and final results only, never inside an iteration.
    template <typename T>
    void read(std::span<T> values, std::size_t byte_offset = 0) const {
        download(values.data(), values.size_bytes(), byte_offset);
    }

    void clear() const { clear(bytes_); }  ///< all bytes zero
    void clear(std::size_t bytes) const;   ///< so many from its beginning on, a multiple of 4
    void bind_storage(GLuint binding) const;
    void bind_uniform(GLuint binding) const;
    [[nodiscard]] GLuint get() const { return name_.get(); }
    [[nodiscard]] std::size_t bytes() const { return bytes_; }

  private:
    void upload(const void* data, std::size_t bytes, std::size_t offset) const;
    void download(void* data, std::size_t bytes, std::size_t offset) const;

    GlName<delete_buffer> name_;
    std::size_t bytes_ = 0;
    void* data_ = nullptr;
};

/// Waits until the GL has carried out all commands so far.
void finish_commands();

/// A buffer seen as a one-dimensional texture of texels. The buffer must outlive it.
Texture2D create_buffer_texture(const std::string& label, GLenum format, const Buffer& buffer);

Texture2D create_texture_2d(const std::string& label, GLenum format, int width, int height);

/// Throws GpuError naming the status where the framebuffer is incomplete.
Framebuffer create_framebuffer(const std::string& label, GLuint colour, GLuint depth);

}  // namespace raybundle
