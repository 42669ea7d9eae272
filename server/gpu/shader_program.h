// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "gpu/gl_objects.h"

namespace raybundle {

/// A linked program from server/shaders (compiled into the executable). `#include "x.glsl"` lines
/// are resolved there; a line in an error message names its file.
class ShaderProgram {
  public:
    ShaderProgram() = default;

    /// files: e.g. {"bundle_raster.vert", "bundle_raster.frag"} or {"solution_update.comp"}; the
    /// extension gives the stage. defines: e.g. {"GLOSSY 1"}. The driver may go on compiling and
    /// linking while further programs are made: the first use waits for it, and throws GpuError
    /// with the compiler's log where the driver rejects the program.
    explicit ShaderProgram(const std::vector<std::string>& files,
                           const std::vector<std::string>& defines = {});

    void use() const { glUseProgram(linked()); }
    void set(const char* name, int value) const;
    void set(const char* name, unsigned value) const;
    void set(const char* name, float value) const;
    void set(const char* name, bool value) const { set(name, value ? 1 : 0); }
    void set(const char* name, const glm::vec3& value) const;
    void set(const char* name, const glm::uvec4& value) const;
    void set(const char* name, const glm::mat4& value) const;
    void set(const char* name, std::span<const glm::vec4> values) const;

    /// Uses the program and runs at least `threads` invocations of its local size (x), numbered by
    /// linear_index() of linear_index.glsl: more groups than the driver takes in a row are folded
    /// into rows. 0 runs nothing. Throws GpuError where even those are too many.
    void dispatch(std::size_t threads) const;
    /// The same over a plane of invocations, which is not folded.
    void dispatch(std::size_t threads_x, std::size_t threads_y) const;
    /// So many work groups. Throws GpuError where these are more than the driver takes.
    void dispatch_groups(std::size_t x, std::size_t y) const;
    /// As many work groups as three numbers of a buffer say.
    void dispatch_indirect(const Buffer& command, std::size_t byte_offset = 0) const;

  private:
    [[nodiscard]] GLint location(const char* name) const;
    /// Waits until the driver is done with the program.
    void finish() const;
    [[nodiscard]] GLuint linked() const;  ///< finished, its name
    [[nodiscard]] std::size_t groups_of(std::size_t threads, int axis) const;

    Program program_;
    std::string label_;
    std::vector<std::string> files_;
    mutable bool finished_ = false;
    mutable GLint local_size_[3] = {1, 1, 1};
    mutable glm::uvec2 most_groups_{0};
};

/// A list of defines and one more.
inline std::vector<std::string> with(std::vector<std::string> defines, const std::string& define) {
    defines.push_back(define);
    return defines;
}

/// Makes shader writes visible to everything that follows.
inline void storage_barrier() {
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT |
                    GL_TEXTURE_FETCH_BARRIER_BIT | GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT |
                    GL_COMMAND_BARRIER_BIT);
}

}  // namespace raybundle
