// SPDX-License-Identifier: Apache-2.0
// What the driver takes, asked for and checked in one place. All need a current context unless
// they say otherwise, and throw GpuError that names what does not fit, its size and the limit.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <string>

namespace raybundle {

/// Work groups of a dispatch along x and y.
glm::uvec2 most_work_groups();

/// Rows of groups for a dispatch of one dimension, as few as there can be, whose last one is the
/// shortest. Needs no context.
glm::uvec2 folded(std::size_t groups, const glm::uvec2& most, const std::string& label);

/// Needs no context.
void check_work_groups(std::size_t x, std::size_t y, const glm::uvec2& most,
                       const std::string& label);

/// Bytes of a buffer that shaders can reach as storage.
std::size_t most_storage_bytes();

/// A buffer that shaders reach as storage.
void check_storage(const std::string& label, std::size_t bytes);

/// A buffer seen as texels of so many bytes.
void check_buffer_texture(const std::string& label, std::size_t bytes, std::size_t texel_bytes);

void check_texture_2d(const std::string& label, int width, int height);

/// Largest width and height of a picture that is drawn at once.
unsigned most_picture_edge();

void check_texture_layers(const std::string& label, unsigned layers);

/// What glGetError() has answered; `doing` says what was under way. Throws GlError. Needs no
/// context.
void throw_gl_error(unsigned error, const std::string& doing);

/// Throws GlError where the driver has refused a command since the last call: nothing that was
/// drawn or computed since then can be relied on.
void check_gl_errors(const std::string& doing);

}  // namespace raybundle
