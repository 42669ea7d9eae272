// SPDX-License-Identifier: Apache-2.0
#include "gpu/shader_program.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <glm/gtc/type_ptr.hpp>
#include <sstream>
#include <string_view>

#include "embedded_file.h"
#include "gpu/egl_context.h"
#include "gpu/gl_limits.h"
#include "gpu/gl_scope.h"

namespace raybundle {

namespace {

constexpr int max_include_depth = 8;

std::string_view find_shader(const std::string& name) {
    for (const EmbeddedFile& file : shader_files()) {
        if (file.name.substr(file.name.rfind('/') + 1) == name) {
            return file.contents;
        }
    }
    throw GpuError("shader file '" + name + "' is not part of this executable");
}

/// Expands includes; guards let each file in once. Lines keep their numbers; the file's index in
/// `names` is the string number.
void expand(const std::string& name, int depth, std::vector<std::string>& names, std::string& out) {
    if (depth > max_include_depth) {
        throw GpuError("shader file '" + name + "': includes nest too deeply");
    }
    const std::size_t index = names.size();
    names.push_back(name);
    std::istringstream lines{std::string(find_shader(name))};
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        if (line.rfind("#include \"", 0) == 0) {
            const std::string included = line.substr(10, line.find('"', 10) - 10);
            const std::string guard = "INCLUDED_" + included.substr(0, included.find('.'));
            out.append("#ifndef ").append(guard).append("\n#define ").append(guard).append("\n");
            out += "#line 1 " + std::to_string(names.size()) + "\n";
            expand(included, depth + 1, names, out);
            out += "#endif\n";
            out += "#line " + std::to_string(number + 1) + " " + std::to_string(index) + "\n";
        } else {
            out += line + "\n";
        }
    }
}

GLenum stage_of(const std::string& file) {
    const std::string extension = file.substr(file.rfind('.') + 1);
    if (extension == "vert") {
        return GL_VERTEX_SHADER;
    }
    if (extension == "frag") {
        return GL_FRAGMENT_SHADER;
    }
    if (extension == "comp") {
        return GL_COMPUTE_SHADER;
    }
    throw GpuError("shader file '" + file + "' has an unknown stage");
}

/// Compiles a shader, or lets the driver begin to.
GLuint compile(const std::string& file, const std::vector<std::string>& defines) {
    std::string text = "#version 450 core\n";
    for (const std::string& define : defines) {
        text += "#define " + define + "\n";
    }
    if (is_software_renderer()) {
        text += "#define SOFTWARE_RENDERER\n";
    }
    std::vector<std::string> names;
    text += "#line 1 0\n";
    expand(file, 0, names, text);
    const GLuint shader = glCreateShader(stage_of(file));
    const char* source = text.c_str();
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    return shader;
}

constexpr GLsizei max_log = 4096;

/// Throws GpuError where the driver rejects one of the program's shaders.
void check_shaders(GLuint program, const std::vector<std::string>& files) {
    std::vector<GLuint> shaders(files.size());
    GLsizei count = 0;
    glGetAttachedShaders(program, static_cast<GLsizei>(shaders.size()), &count, shaders.data());
    shaders.resize(static_cast<std::size_t>(count));
    for (const GLuint shader : shaders) {
        GLint ok = GL_FALSE;
        glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
        if (ok == GL_TRUE) {
            continue;
        }
        GLint stage = 0;
        glGetShaderiv(shader, GL_SHADER_TYPE, &stage);
        const auto file = std::find_if(files.begin(), files.end(), [&](const std::string& f) {
            return stage_of(f) == static_cast<GLenum>(stage);
        });
        std::vector<std::string> names;
        std::string text;
        expand(*file, 0, names, text);
        std::string numbers;
        for (std::size_t i = 0; i < names.size(); ++i) {
            numbers += (i == 0 ? "" : ", ") + std::to_string(i) + " = " + names[i];
        }
        char log[max_log] = "";
        glGetShaderInfoLog(shader, max_log, nullptr, log);
        throw GpuError("the driver rejects shader " + *file + " (string numbers: " + numbers +
                       "):\n" + log);
    }
}

}  // namespace

ShaderProgram::ShaderProgram(const std::vector<std::string>& files,
                             const std::vector<std::string>& defines)
    : program_(glCreateProgram()), label_(files.back()), files_(files) {
    glObjectLabel(GL_PROGRAM, program_.get(), -1, label_.c_str());
    for (const std::string& file : files) {
        const GLuint shader = compile(file, defines);
        glAttachShader(program_.get(), shader);
        glDeleteShader(shader);  // lives on as part of the program
    }
    glLinkProgram(program_.get());
}

GLuint ShaderProgram::linked() const {
    finish();
    return program_.get();
}

void ShaderProgram::finish() const {
    if (finished_) {
        return;
    }
    const auto start = std::chrono::steady_clock::now();
    GLint ok = GL_FALSE;
    glGetProgramiv(program_.get(), GL_LINK_STATUS, &ok);
    if (ok == GL_FALSE) {
        check_shaders(program_.get(), files_);
        char log[max_log] = "";
        glGetProgramInfoLog(program_.get(), max_log, nullptr, log);
        throw GpuError("the driver cannot link shader " + label_ + ":\n" + log);
    }
    if (stage_of(label_) == GL_COMPUTE_SHADER) {
        glGetProgramiv(program_.get(), GL_COMPUTE_WORK_GROUP_SIZE, local_size_);
        most_groups_ = most_work_groups();
    }
    finished_ = true;
    const std::chrono::duration<double, std::milli> waited =
        std::chrono::steady_clock::now() - start;
    spdlog::debug("waited {:.1f} ms for shader {}", waited.count(), label_);
}

GLint ShaderProgram::location(const char* name) const {
    return glGetUniformLocation(linked(), name);
}
void ShaderProgram::set(const char* name, int value) const {
    glProgramUniform1i(program_.get(), location(name), value);
}
void ShaderProgram::set(const char* name, unsigned value) const {
    glProgramUniform1ui(program_.get(), location(name), value);
}
void ShaderProgram::set(const char* name, float value) const {
    glProgramUniform1f(program_.get(), location(name), value);
}
void ShaderProgram::set(const char* name, const glm::vec3& value) const {
    glProgramUniform3fv(program_.get(), location(name), 1, glm::value_ptr(value));
}
void ShaderProgram::set(const char* name, const glm::uvec4& value) const {
    glProgramUniform4uiv(program_.get(), location(name), 1, glm::value_ptr(value));
}
void ShaderProgram::set(const char* name, const glm::mat4& value) const {
    glProgramUniformMatrix4fv(program_.get(), location(name), 1, GL_FALSE, glm::value_ptr(value));
}
void ShaderProgram::set(const char* name, std::span<const glm::vec4> values) const {
    glProgramUniform4fv(program_.get(), location(name), static_cast<GLsizei>(values.size()),
                        glm::value_ptr(values.front()));
}

std::size_t ShaderProgram::groups_of(std::size_t threads, int axis) const {
    finish();  // the local size is known from then on
    const auto local = static_cast<std::size_t>(local_size_[axis]);
    return (threads + local - 1) / local;
}

void ShaderProgram::dispatch(std::size_t threads) const {
    if (threads > 0) {
        const glm::uvec2 groups = folded(groups_of(threads, 0), most_groups_, label_);
        dispatch_groups(groups.x, groups.y);
    }
}

void ShaderProgram::dispatch(std::size_t threads_x, std::size_t threads_y) const {
    if (threads_x > 0 && threads_y > 0) {
        dispatch_groups(groups_of(threads_x, 0), groups_of(threads_y, 1));
    }
}

void ShaderProgram::dispatch_groups(std::size_t x, std::size_t y) const {
    const GlScope scope(label_.c_str());
    use();
    check_work_groups(x, y, most_groups_, label_);
    glDispatchCompute(static_cast<GLuint>(x), static_cast<GLuint>(y), 1);
    storage_barrier();
}

void ShaderProgram::dispatch_indirect(const Buffer& command, std::size_t byte_offset) const {
    const GlScope scope(label_.c_str());
    use();
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, command.get());
    glDispatchComputeIndirect(static_cast<GLintptr>(byte_offset));
    storage_barrier();
}

}  // namespace raybundle
